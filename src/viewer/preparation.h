// What takes long before a scene can be drawn: loading it, light transport tables, irradiance volumes. It is
// done beside the window, which goes on with what there is.
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

// Everything that drawing needs of the host. Stays where it was made: its parts look at each other.
struct Prepared {
  Scene scene;
  PictureSettings settings;
  Progress progress;
  std::unique_ptr<SceneTransport> transport;
};

// One such piece of work, on a thread of its own. Destroyed before it is done, it is cancelled and waited
// for.
class Preparation {
 public:
  // `load` gives the scene; it is called on that thread.
  Preparation(std::function<Scene()> load, const PictureSettings& settings);
  ~Preparation();
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;

  void cancel() { prepared_->progress.cancel(); }
  bool isDone() const { return isDone_; }
  Progress::State progress() const { return prepared_->progress.state(); }
  // When it is done. Throws what went wrong, Interrupted where it was cancelled.
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
