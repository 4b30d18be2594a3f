#include "viewer/preparation.h"

#include "techniques/registry.h"

namespace nephroid {

Preparation::Preparation(std::function<Scene()> load, const PictureSettings& settings)
    : load_(std::move(load)), prepared_(std::make_unique<Prepared>()) {
  prepared_->settings = settings;
  thread_ = std::thread([this] {
    try {
      prepare();
    } catch (...) {
      failure_ = std::current_exception();
    }
    isDone_ = true;
  });
}

Preparation::~Preparation() {
  if (prepared_) cancel();
  if (thread_.joinable()) thread_.join();
}

void Preparation::prepare() {
  Prepared& made = *prepared_;
  made.progress.begin("Loading the scene", 1);
  made.scene = load_();
  made.progress.advance();
  made.progress.begin("Rays", 1);
  made.transport =
      std::make_unique<SceneTransport>(made.scene, transportOf(made.settings.technique), made.progress);
  made.progress.advance();
  const TechniqueInfo& info = techniqueNamed(made.settings.technique.technique);
  if (info.prepare) info.prepare(made.scene, *made.transport, made.settings.technique, made.progress);
}

std::unique_ptr<Prepared> Preparation::take() {
  thread_.join();
  if (failure_) std::rethrow_exception(failure_);
  return std::move(prepared_);
}

}  // namespace nephroid
