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
    : scene(sceneToSee),
      settings(referenceSettings),
      boundaries(scene, rays),
      lights(scene, Aim::casters),
      tracer(scene, boundaries, lights, settings.paths),
      sight(scene, boundaries, lights),
      camera(scene.camera, settings.size),
      mediaOfCamera(boundaries.mediaAround(scene.camera.position)),
      total(std::size_t(settings.size.x) * settings.size.y),
      direct(total),
      caustics(total),
      shafts(total) {}

PassLight ReferenceImage::traceLight(std::vector<Splat>& splats) const {
  const PhotonPass pass = photonPass(scene, settings.spectrum, settings.seed, passesDone, settings.photons);
  KeeperSettings keeping{&scene, &boundaries, &camera, &pass.bands, mediaOfCamera.top()};
  keeping.splats = settings.seenDirectly == SeenDirectly::splatted;
  FluxLedger ledger;
  std::vector<PhotonKeeper> groups = tracePass(tracer, pass, PhotonKeeper(keeping), ledger);
  splats = joined(groups, &PhotonKeeper::splats);
  const float left = kernelLeft(passesDone);
  const float surfaceRadius = kFirstRadius * camera.pixelHeight() * std::sqrt(left);
  const float volumeRadius = kFirstRadiusInVolumes * camera.pixelHeight() * std::cbrt(left);
  const float middle = distance(scene.camera.target, scene.camera.position);  // m
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
  const std::size_t pixels = std::size_t(settings.size.x) * settings.size.y;
  std::vector<vec3> all(pixels), straight(pixels), fromCasters(pixels), scattered(pixels);
  oneapi::tbb::parallel_for(0u, settings.size.y, [&](uint32_t row) {
    for (uint32_t column = 0; column < settings.size.x; ++column) {
      const std::size_t i = std::size_t(row) * settings.size.x + column;
      Random random = randomOf(~settings.seed, passesDone, i);
      const vec2 pixel(float(column) + random.uniform(), float(row) + random.uniform());
      const Seen seen = sight.look(camera.rayThrough(pixel), mediaOfCamera, light, random);
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
  ++passesDone;
  total.add(all, passesDone);
  direct.add(straight, passesDone);
  caustics.add(fromCasters, passesDone);
  shafts.add(scattered, passesDone);
}

double ReferenceImage::noise() const {
  const double ofCaustics = caustics.noise();
  return std::isfinite(ofCaustics) ? ofCaustics : total.noise();
}

Image ReferenceImage::image() const {
  Image image;
  image.width = settings.size.x;
  image.height = settings.size.y;
  total.writeMean(image, "");
  direct.writeMean(image, "direct.");
  caustics.writeMean(image, "caustics.");
  shafts.writeMean(image, "shafts.");
  total.writeVariance(image, "variance.");
  caustics.writeVariance(image, "caustics.variance.");
  image.channel("depth.Z");
  for (const char* axis : {"normal.X", "normal.Y", "normal.Z"}) image.channel(axis);
  for (std::size_t i = 0; i < image.pixelCount(); ++i) {
    const Ray ray = camera.rayThrough(vec2(i % settings.size.x, i / settings.size.x) + 0.5f);
    Hit hit;
    if (!boundaries.rayScene().intersect(ray, hit)) continue;
    const vec3 normal = dot(ray.direction, hit.geometricNormal) < 0 ? hit.normal : -hit.normal;
    image.channel("depth.Z")[i] = hit.distance * dot(ray.direction, camera.forward());
    for (int axis = 0; axis < 3; ++axis)
      image.channel(std::string("normal.") + "XYZ"[axis])[i] = normal[axis];
  }
  return image;
}

void ReferenceImage::restore(const Image& image, uint32_t passes) {
  total.readMean(image, "");
  direct.readMean(image, "direct.");
  caustics.readMean(image, "caustics.");
  shafts.readMean(image, "shafts.");
  total.readVariance(image, "variance.");
  caustics.readVariance(image, "caustics.variance.");
  passesDone = passes;
}

}  // namespace nephroid
