#include "reference/image.h"

#include <cmath>

namespace nephroid {
namespace {

constexpr float kFirstRadius = 2;            // pixels, of the first pass, on surfaces
constexpr float kFirstRadiusInVolumes = 10;  // pixels
constexpr float kShrinking = 2.0f / 3;       // alpha of Knaus and Zwicker 2011, eq. 15

// What is left of the first pass's area or volume in the pass of an index from 0.
float kernelLeft(uint32_t pass) {
  double left = 1;
  for (uint32_t i = 1; i <= pass; ++i) left *= (i + double(kShrinking)) / (i + 1.0);
  return static_cast<float>(left);
}

template <class T>
std::vector<T> joined(std::vector<PhotonKeeper>& groups, std::vector<T> PhotonKeeper::*part) {
  std::vector<T> all;
  std::size_t count = 0;
  for (const PhotonKeeper& group : groups) count += (group.*part).size();
  all.reserve(count);
  for (PhotonKeeper& group : groups) {
    all.insert(all.end(), (group.*part).begin(), (group.*part).end());
    (group.*part) = {};
  }
  return all;
}

}  // namespace

ReferenceImage::ReferenceImage(const Scene& sceneToSee, const RayScene& rays,
                               const ReferenceSettings& referenceSettings)
    : scene_(sceneToSee),
      settings_(referenceSettings),
      boundaries_(scene_, rays),
      lights_(scene_, Aim::casters),
      tracer_(scene_, boundaries_, lights_, settings_.paths),
      sight_(scene_, boundaries_, lights_),
      camera_(scene_.camera, settings_.size),
      mediaOfCamera_(boundaries_.mediaAround(scene_.camera.position)),
      total_(std::size_t(settings_.size.x) * settings_.size.y),
      direct_(total_),
      caustics_(total_),
      shafts_(total_) {}

PassLight ReferenceImage::traceLight(std::vector<Splat>& splats) const {
  const PhotonPass pass =
      photonPass(scene_, settings_.spectrum, settings_.seed, passesDone_, settings_.photons);
  KeeperSettings keeping{&scene_, &boundaries_, &camera_, &pass.bands, mediaOfCamera_.top()};
  keeping.splats = settings_.seenDirectly == SeenDirectly::splatted;
  FluxLedger ledger;
  std::vector<PhotonKeeper> groups = tracePass(tracer_, pass, PhotonKeeper(keeping), ledger);
  splats = joined(groups, &PhotonKeeper::splats);
  const float left = kernelLeft(passesDone_);
  const float surfaceRadius = kFirstRadius * camera_.pixelHeight() * std::sqrt(left);
  const float volumeRadius = kFirstRadiusInVolumes * camera_.pixelHeight() * std::cbrt(left);
  const float middle = distance(scene_.camera.target, scene_.camera.position);  // m
  return {pass.bands,
          PhotonMap(joined(groups, &PhotonKeeper::onSurfaces), 2 * surfaceRadius * middle),
          PhotonMap(joined(groups, &PhotonKeeper::inVolumes), 2 * volumeRadius * middle),
          surfaceRadius,
          volumeRadius,
          3 * surfaceRadius * middle,
          keeping.splats};
}

void ReferenceImage::pass() {
  std::vector<Splat> splats;
  const PassLight light = traceLight(splats);
  const std::size_t pixels = std::size_t(settings_.size.x) * settings_.size.y;
  std::vector<vec3> all(pixels), straight(pixels), fromCasters(pixels), scattered(pixels);
  oneapi::tbb::parallel_for(0u, settings_.size.y, [&](uint32_t row) {
    for (uint32_t column = 0; column < settings_.size.x; ++column) {
      const std::size_t i = std::size_t(row) * settings_.size.x + column;
      Random random = randomOf(~settings_.seed, passesDone_, i);
      const vec2 pixel(float(column) + random.uniform(), float(row) + random.uniform());
      const Seen seen = sight_.look(camera_.rayThrough(pixel), mediaOfCamera_, light, random);
      straight[i] = seen.direct;
      fromCasters[i] = seen.caustics;
      scattered[i] = seen.shafts;
      all[i] = seen.direct + seen.caustics + seen.shafts + seen.rest;
    }
  });
  for (const Splat& splat : splats) {
    (splat.isScattered ? scattered : fromCasters)[splat.pixel] += splat.luminance;
    all[splat.pixel] += splat.luminance;
  }
  ++passesDone_;
  total_.add(all, passesDone_);
  direct_.add(straight, passesDone_);
  caustics_.add(fromCasters, passesDone_);
  shafts_.add(scattered, passesDone_);
}

double ReferenceImage::noise() const {
  const double ofCaustics = caustics_.noise();
  return std::isfinite(ofCaustics) ? ofCaustics : total_.noise();
}

Image ReferenceImage::image() const {
  Image image;
  image.width = settings_.size.x;
  image.height = settings_.size.y;
  total_.writeMean(image, "");
  direct_.writeMean(image, "direct.");
  caustics_.writeMean(image, "caustics.");
  shafts_.writeMean(image, "shafts.");
  total_.writeVariance(image, "variance.");
  caustics_.writeVariance(image, "caustics.variance.");
  image.channel("depth.Z");
  for (const char* axis : {"normal.X", "normal.Y", "normal.Z"}) image.channel(axis);
  for (std::size_t i = 0; i < image.pixelCount(); ++i) {
    const Ray ray = camera_.rayThrough(vec2(i % settings_.size.x, i / settings_.size.x) + 0.5f);
    Hit hit;
    if (!boundaries_.rayScene().intersect(ray, hit)) continue;
    const vec3 normal = dot(ray.direction, hit.geometricNormal) < 0 ? hit.normal : -hit.normal;
    image.channel("depth.Z")[i] = hit.distance * dot(ray.direction, camera_.forward());
    for (int axis = 0; axis < 3; ++axis)
      image.channel(std::string("normal.") + "XYZ"[axis])[i] = normal[axis];
  }
  return image;
}

void ReferenceImage::restore(const Image& image, uint32_t passes) {
  total_.readMean(image, "");
  direct_.readMean(image, "direct.");
  caustics_.readMean(image, "caustics.");
  shafts_.readMean(image, "shafts.");
  total_.readVariance(image, "variance.");
  caustics_.readVariance(image, "caustics.variance.");
  passesDone_ = passes;
}

}  // namespace nephroid
