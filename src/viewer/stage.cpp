#include "viewer/stage.h"

#include <algorithm>

#include "techniques/registry.h"

namespace nephroid {
namespace {

constexpr uint32_t kEnoughSamples = 8;  // for edges as smooth as smoothing makes them

}  // namespace

Stage::Stage(gpu::Device& device, std::shared_ptr<Prepared> prepared, uvec2 size, bool keepsLight)
    : device_(device),
      prepared_(std::move(prepared)),
      keepsLight_(keepsLight),
      technique_(newTechnique()),
      renderer_(newRenderer(*technique_, size)),
      edges_(std::make_unique<EdgeSmoothing>(device, size)),
      picture_(&edges_->smoothed()) {}

std::unique_ptr<Technique> Stage::newTechnique() {
  return makeTechnique({device_, prepared_->settings.technique, *prepared_->transport, stats_, Casters::all,
                        &prepared_->progress});
}

std::unique_ptr<Renderer> Stage::newRenderer(Technique& technique, uvec2 size) const {
  RenderSettings settings = renderSettings(prepared_->settings, size);
  settings.keepsLight = keepsLight_;
  settings.samples = 1;
  return std::make_unique<Renderer>(device_, *prepared_->transport, settings, technique);
}

void Stage::remake() {
  std::unique_ptr<Technique> technique = newTechnique();
  auto edges = std::make_unique<EdgeSmoothing>(device_, size());
  renderer_ = newRenderer(*technique, size());
  edges_ = std::move(edges);
  picture_ = &edges_->smoothed();
  technique_ = std::move(technique);
}

void Stage::resize(uvec2 size) {
  renderer_->resize(size);
  edges_->resize(size);
  picture_ = &edges_->smoothed();
}

std::vector<PassTime> Stage::render(const Scene& scene) {
  std::vector<PassTime> passes = renderer_->render(scene);
  edges_->smooth(renderer_->images().picture, passes);
  picture_ = &edges_->smoothed();
  return passes;
}

std::vector<PassTime> Stage::gather(uint32_t samples) {
  std::vector<PassTime> passes = renderer_->gather(samples);
  if (renderer_->gathered() >= std::min(samples, kEnoughSamples)) picture_ = &renderer_->images().picture;
  return passes;
}

std::vector<Lattice> Stage::lattices() const {
  std::vector<Lattice> all = technique_->lattices();
  for (const Lattice& slice : renderer_->slices()) all.push_back(slice);
  return all;
}

}  // namespace nephroid
