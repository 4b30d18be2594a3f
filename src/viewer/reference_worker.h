// The reference, refined beside the window from where the camera is, and what the picture is off it.
#pragma once

#include <atomic>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "reference/refine.h"
#include "report/metrics.h"
#include "scene/scene.h"

namespace nephroid {

// What `image` is off the reference, pixel by pixel.
struct ErrorView {
  LayerErrors total, caustics;
  double scaleEnd = 0;  // the relative error that the strongest colors stand for
  ByteImage picture;    // signedMap of the relative errors of the total
};

ErrorView errorView(const Image& reference, const Image& image);

struct ReferenceView {
  uint32_t passes = 0;
  double noise = 0;   // relative standard error of the caustics
  ByteImage picture;  // tone-mapped
  std::optional<ErrorView> error;
  std::string failure;  // what went wrong; empty: nothing
};

class ReferenceWorker {
 public:
  ReferenceWorker();
  ~ReferenceWorker();
  ReferenceWorker(const ReferenceWorker&) = delete;
  ReferenceWorker& operator=(const ReferenceWorker&) = delete;

  // Refines this scene from now on; what went before is ended, and not waited for.
  void start(const Scene& scene, const ReferenceSettings& settings);
  void stop();
  bool isRunning() const { return job_ != nullptr; }

  // From the next pass on, errors are those of `image` (nit), which is of the reference's size.
  void compare(Image image);

  // The last there is; null before the first pass.
  std::shared_ptr<const ReferenceView> newest() const;

 private:
  struct Job;
  static void refine(Job& job);

  std::unique_ptr<Job> job_;
  std::list<std::unique_ptr<Job>> ending_;
};

// As the technique's model has it: of the same paths, and of channels where it follows refraction alone.
ReferenceSettings referenceSettingsFor(Paths paths, uvec2 size);

}  // namespace nephroid
