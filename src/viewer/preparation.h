// The long work before a scene can be drawn: loading, light transport tables, irradiance volumes. It runs on
// another thread, while the window shows the old scene.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "core/progress.h"
#include "render/settings.h"
#include "scene/scene.h"
#include "transport/scene_transport.h"

namespace nephroid {

// Everything on the host that drawing needs. It must not be moved in memory, because its parts refer to each
// other.
struct Prepared {
  Scene scene;
  PictureSettings settings;
  Progress progress;
  std::unique_ptr<SceneTransport> transport;
};

// One preparation, on its own thread. The destructor cancels it and waits for it.
class Preparation {
 public:
  // `load` returns the scene; it is called on that thread.
  Preparation(std::function<Scene()> load, const PictureSettings& settings);
  ~Preparation();
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;

  void cancel() { prepared_->progress.cancel(); }
  bool isDone() const { return isDone_; }
  Progress::State progress() const { return prepared_->progress.state(); }
  // The result. To be called when isDone(). Throws the exception of the work, or Interrupted where it was
  // canceled.
  std::unique_ptr<Prepared> take();

 private:
  void prepare();

  std::function<Scene()> load_;
  std::unique_ptr<Prepared> prepared_;
  std::exception_ptr failure_;
  std::atomic<bool> isDone_{false};
  std::thread thread_;
};

}  // namespace nephroid
