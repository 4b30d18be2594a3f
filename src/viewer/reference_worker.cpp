#include "viewer/reference_worker.h"

#include <algorithm>
#include <cmath>

#include "reference/image.h"
#include "render/metering.h"
#include "render/picture.h"
#include "report/false_color.h"

namespace nephroid {
namespace {

constexpr uint32_t kPhotonsOfAPass = 1u << 18;  // few, so that the first picture is there soon
constexpr double kShownQuantile = 0.95;         // of the relative errors, where the scale ends

}  // namespace

struct ReferenceWorker::Job {
  Scene scene;
  ReferenceSettings settings;
  std::atomic<bool> isStopped{false}, isEnded{false};
  std::mutex sharing;  // protects `compared` and `newest`
  std::shared_ptr<const Image> compared;
  std::shared_ptr<const ReferenceView> newest;
  std::thread thread;

  ~Job() {
    isStopped = true;
    if (thread.joinable()) thread.join();
  }
};

ErrorView errorView(const Image& reference, const Image& image) {
  ErrorView view;
  view.total = layerErrors(reference, image, "");
  view.caustics = layerErrors(reference, image, "caustics.");
  const std::vector<float> errors = relativeErrors(reference, image, "");
  std::vector<float> magnitudes = errors;
  for (float& magnitude : magnitudes) magnitude = std::abs(magnitude);
  view.scaleEnd = std::max(endOfScale(quantile(std::move(magnitudes), kShownQuantile)), 0.01);
  view.picture = signedMap(errors, image.width, image.height, view.scaleEnd);
  return view;
}

ReferenceSettings referenceSettingsFor(Paths paths, uvec2 size) {
  ReferenceSettings settings;
  settings.size = size;
  settings.paths = paths;
  settings.spectrum = paths == Paths::transmission ? Spectrum::channels : Spectrum::continuous;
  settings.photons = kPhotonsOfAPass;
  return settings;
}

ReferenceWorker::ReferenceWorker() = default;

ReferenceWorker::~ReferenceWorker() {
  stop();
}

void ReferenceWorker::refine(Job& job) {
  const RayScene rays(job.scene);
  ReferenceImage estimate(job.scene, rays, job.settings);
  while (!job.isStopped) {
    estimate.pass();
    ReferenceView view;
    const Image image = estimate.image();
    view.passes = estimate.passes();
    view.noise = estimate.noise();
    view.picture = pictureOf(image, toneMappingOf(job.scene.camera, image));
    std::shared_ptr<const Image> compared;
    {
      const std::lock_guard lock(job.sharing);
      compared = job.compared;
    }
    if (compared) view.error = errorView(image, *compared);
    const std::lock_guard lock(job.sharing);
    job.newest = std::make_shared<const ReferenceView>(std::move(view));
  }
}

void ReferenceWorker::start(const Scene& scene, const ReferenceSettings& settings) {
  stop();
  job_ = std::make_unique<Job>();
  job_->scene = scene;
  job_->settings = settings;
  job_->thread = std::thread([&job = *job_] {
    try {
      refine(job);
    } catch (const std::exception& wrong) {
      ReferenceView view;
      view.failure = wrong.what();
      const std::lock_guard lock(job.sharing);
      job.newest = std::make_shared<const ReferenceView>(std::move(view));
    }
    job.isEnded = true;
  });
}

void ReferenceWorker::stop() {
  std::erase_if(ending_, [](const auto& job) { return job->isEnded.load(); });
  if (!job_) return;
  job_->isStopped = true;
  ending_.push_back(std::move(job_));
}

void ReferenceWorker::compare(Image image) {
  if (!job_) return;
  const std::lock_guard lock(job_->sharing);
  job_->compared = std::make_shared<const Image>(std::move(image));
}

std::shared_ptr<const ReferenceView> ReferenceWorker::newest() const {
  if (!job_) return nullptr;
  const std::lock_guard lock(job_->sharing);
  return job_->newest;
}

}  // namespace nephroid
