#include "reference/image.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/color.h"
#include "core/pixel_filter.h"

namespace nephroid {
namespace {

constexpr float kFirstRadius = 2;            // pixels, of the first pass, on surfaces
constexpr float kFirstRadiusInVolumes = 10;  // pixels
constexpr uint32_t kMostPhotonsInPart = 1u << 20;
constexpr uint64_t kMostLooks = 16;
constexpr uint32_t kPilotsInPart = 16;  // of the parts that photons are guided by
constexpr double kMostPilotLooks = 1 << 15;
constexpr float kShrinking = 2.0f / 3;  // alpha of Knaus and Zwicker 2011, eq. 15

// What is left of the first kernel's area or volume in the part of an index from 0, counted over all passes.
float kernelLeft(uint32_t part) {
  double left = 1;
  for (uint32_t i = 1; i <= part; ++i) left *= (i + double(kShrinking)) / (i + 1.0);
  return static_cast<float>(left);
}

// A pass is traced in parts, so that its photons need not all be kept at a time.
uint32_t partsOf(const ReferenceSettings& settings) {
  return (settings.photons + kMostPhotonsInPart - 1) / kMostPhotonsInPart;
}

// Into each pixel in a pass, at least one for each part: about as many as photons, as both take time alike.
uint32_t looksOf(const ReferenceSettings& settings, uint32_t parts) {
  const uint64_t pixels = std::max(uint64_t(settings.size.x) * settings.size.y, uint64_t{1});
  return std::max(parts, uint32_t(std::clamp(settings.photons / pixels, uint64_t{1}, kMostLooks)));
}

// Pixels from the picture's corner, by the filter. Evenly spread numbers in [0, 1) give evenly spread places.
vec2 placeInPixel(uvec2 pixel, float u) {
  const vec2 even = pointOnCurve(double(u));
  return vec2(pixel) + 0.5f + vec2(quickFilteredOffset(even.x), quickFilteredOffset(even.y));
}

// Adds a splat to the pixels whose filter it is in.
void addSplat(const Splat& splat, uvec2 size, std::vector<vec3>& layer, std::vector<vec3>& total) {
  const ivec2 low = max(ivec2(glm::ceil(splat.place - 0.5f - float(kFilterRadius))), ivec2(0));
  const ivec2 high = min(ivec2(glm::floor(splat.place - 0.5f + float(kFilterRadius))), ivec2(size) - 1);
  const auto weight = [](float place, int pixel) {
    return float(filterDensity(double(place) - double(pixel) - 0.5));
  };
  for (int y = low.y; y <= high.y; ++y) {
    const vec3 inRow = weight(splat.place.y, y) * splat.luminance;
    for (int x = low.x; x <= high.x; ++x) {
      const vec3 luminance = weight(splat.place.x, x) * inRow;
      const std::size_t pixel = std::size_t(y) * size.x + std::size_t(x);
      layer[pixel] += luminance;
      total[pixel] += luminance;
    }
  }
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
      shafts_(total_) {
  // They may take a quarter as long as a pass.
  settings_.pilots = std::min(settings_.pilots, settings_.photons / 4);
  if (!tracer_.isDark() && settings_.pilots >= kPilotsInPart) tracer_.guide(findGuide());
}

// By a few photons, sent evenly, and by looks spread over the picture, in one thread.
PhotonGuide ReferenceImage::findGuide() const {
  const uint32_t parts = std::bit_floor(settings_.pilots / kPilotsInPart);
  const PhotonPass pass =
      photonPass(scene_, settings_.spectrum, settings_.seed, ~uint64_t{0}, parts * kPilotsInPart);
  std::vector<Splat> splats;
  PassLight light = traceLight(pass, splats);
  PhotonWorths worths{std::vector<double>(parts, 0.0), kPilotsInPart};
  for (const Splat& splat : splats) worths.add(splat.photon, luminanceOf(splat.luminance));
  const double pixels = double(settings_.size.x) * settings_.size.y;
  const auto step = uint32_t(std::ceil(std::sqrt(pixels / kMostPilotLooks)));  // pixels
  PhotonWorths gathered{std::vector<double>(parts, 0.0), kPilotsInPart};
  light.worths = &gathered;
  for (uint32_t row = step / 2; row < settings_.size.y; row += step)
    for (uint32_t column = step / 2; column < settings_.size.x; column += step) {
      Draws draws(randomOf(~settings_.seed, pass.index, uint64_t(row) * settings_.size.x + column), 0, 1);
      sight_.look(camera_.rayThrough(placeInPixel({column, row}, draws.uniform())), mediaOfCamera_, light,
                  draws);
    }
  for (uint32_t i = 0; i < parts; ++i) worths.squares[i] += gathered.squares[i] * step * step;
  return PhotonGuide(worths.squares);
}

PassLight ReferenceImage::traceLight(const PhotonPass& pass, std::vector<Splat>& splats) const {
  KeeperSettings keeping{&scene_, &boundaries_, &camera_, &pass, mediaOfCamera_.top()};
  keeping.splats = settings_.seenDirectly == SeenDirectly::splatted;
  FluxLedger ledger;
  std::vector<PhotonKeeper> groups = tracePass(tracer_, pass, PhotonKeeper(keeping), ledger);
  splats = joined(groups, &PhotonKeeper::splats);
  const float left = kernelLeft(passesDone_ * pass.parts + pass.part);
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

// The looks that a part of the pass gives light to.
void ReferenceImage::look(const PhotonPass& pass, const PassLight& light, PassSums& sums) const {
  const uint32_t looks = looksOf(settings_, pass.parts);
  const float weight = 1 / float(looks);
  oneapi::tbb::parallel_for(0u, settings_.size.y, [&](uint32_t row) {
    for (uint32_t column = 0; column < settings_.size.x; ++column) {
      const std::size_t i = std::size_t(row) * settings_.size.x + column;
      const Random random = randomOf(~settings_.seed, passesDone_, i);
      for (uint32_t look = pass.part; look < looks; look += pass.parts) {
        Draws draws(random, look, looks);
        const vec2 place = placeInPixel({column, row}, draws.uniform());
        const Seen seen = sight_.look(camera_.rayThrough(place), mediaOfCamera_, light, draws);
        sums.direct[i] += weight * seen.direct;
        sums.caustics[i] += weight * seen.caustics;
        sums.shafts[i] += weight * seen.shafts;
        sums.total[i] += weight * (seen.direct + seen.caustics + seen.shafts + seen.rest);
      }
    }
  });
}

void ReferenceImage::pass() {
  PhotonPass pass = photonPass(scene_, settings_.spectrum, settings_.seed, passesDone_, settings_.photons);
  pass.parts = partsOf(settings_);
  const std::vector<vec3> none(std::size_t(settings_.size.x) * settings_.size.y, vec3(0));
  PassSums sums{none, none, none, none};
  for (pass.part = 0; pass.part < pass.parts; ++pass.part) {
    std::vector<Splat> splats;
    look(pass, traceLight(pass, splats), sums);
    for (const Splat& splat : splats)
      addSplat(splat, settings_.size, splat.isScattered ? sums.shafts : sums.caustics, sums.total);
  }
  ++passesDone_;
  total_.add(sums.total, passesDone_);
  direct_.add(sums.direct, passesDone_);
  caustics_.add(sums.caustics, passesDone_);
  shafts_.add(sums.shafts, passesDone_);
}

double ReferenceImage::noise() const {
  return noiseOf(passesDone_, caustics_, total_);
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
