// Refines the reference on another thread while the window is used, and compares the picture with it.
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

// The errors of an image against the reference.
struct ErrorView {
  LayerErrors total, caustics;
  double scaleEnd = 0;  // the relative error at the end of the color scale
  ByteImage picture;    // signedMap of the relative errors of the total
};

ErrorView errorView(const Image& reference, const Image& image);

struct ReferenceView {
  uint32_t passes = 0;
  double noise = 0;   // relative standard error of the caustics
  ByteImage picture;  // tone-mapped
  std::optional<ErrorView> error;
  std::string failure;  // error message; empty: no error
};

class ReferenceWorker {
 public:
  ReferenceWorker();
  ~ReferenceWorker();
  ReferenceWorker(const ReferenceWorker&) = delete;
  ReferenceWorker& operator=(const ReferenceWorker&) = delete;

  // Starts to refine this scene. The work before is canceled, without waiting for it.
  void start(const Scene& scene, const ReferenceSettings& settings);
  void stop();
  bool isRunning() const { return job_ != nullptr; }

  // Sets the image (nit, of the reference's size) whose errors are computed from the next pass on.
  void compare(Image image);

  // The newest state; null before the first pass.
  std::shared_ptr<const ReferenceView> newest() const;

 private:
  struct Job;
  static void refine(Job& job);

  std::unique_ptr<Job> job_;
  std::list<std::unique_ptr<Job>> ending_;
};

// The settings of a reference that matches the techniques: the same paths, and color channels where only
// refraction is followed.
ReferenceSettings referenceSettingsFor(Paths paths, uvec2 size);

}  // namespace nephroid
