#include "irradiance_volume/harmonics.h"

#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <numbers>

#include "core/index_range.h"
#include "irradiance_volume/volume.h"

namespace nephroid {
namespace {

// Steradians nearer to each direction than to others, by a third of each triangle's.
std::vector<float> solidAngles(const LightSphere& sphere) {
  std::vector<float> angles(sphere.directions().size(), 0);
  for (const uvec3& t : sphere.triangles()) {
    const vec3 a = sphere.directions()[t.x], b = sphere.directions()[t.y], c = sphere.directions()[t.z];
    // Van Oosterom and Strackee 1983.
    const float angle = 2 * std::atan2(std::abs(dot(a, cross(b, c))), 1 + dot(a, b) + dot(b, c) + dot(c, a));
    for (int corner = 0; corner < 3; ++corner) angles[t[corner]] += angle / 3;
  }
  return angles;
}

// One share of a light direction's answer.
struct Lookup {
  SampleView view;
  mat3 toFrame;
  float weight;
};

struct Direction {
  std::vector<Lookup> lookups;
  std::vector<float> harmonics;  // times the solid angle
};

std::vector<Direction> directionsOf(IrradianceVolume& base, uint32_t order) {
  const LightSphere sphere(base.key().settings.lightLevel);
  const std::vector<float> angles = solidAngles(sphere);
  std::vector<Direction> directions;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    Direction direction;
    for (const SampleShare& share :
         base.lightSamples().around(sphere.directions()[i], LightInterpolation::rotated))
      direction.lookups.push_back({base.sample(share.sample), base.toFrame(share), share.weight});
    direction.harmonics = sphericalHarmonics(order, sphere.directions()[i]);
    for (float& value : direction.harmonics) value *= angles[i];
    directions.push_back(std::move(direction));
  }
  return directions;
}

// The mean of the base's light for a direction, over the cube with the side `side` around a place.
VolumeLight meanAround(const Direction& direction, vec3 place, float side) {
  constexpr uint32_t kPoints = 8;
  VolumeLight light = noLight();
  for (uint32_t i = 0; i < kPoints; ++i) {
    const vec3 point = place + side * (0.5f * vec3(uvec3(i & 1u, (i >> 1) & 1u, i >> 2)) - 0.25f);
    for (const Lookup& lookup : direction.lookups) {
      const VolumeLight part =
          lightAt(lookup.view.layout, lookup.view.words, kRepresentationGrid, lookup.toFrame * point);
      light.vector += (lookup.weight / kPoints) * (part.vector * lookup.toFrame);
      light.color += (lookup.weight / kPoints) * part.color;
    }
  }
  return light;
}

}  // namespace

std::vector<float> sphericalHarmonics(uint32_t order, vec3 direction) {
  std::vector<float> values(std::size_t{order + 1} * (order + 1));
  const double z = double(direction.z);
  const double planar = std::sqrt(std::max(0.0, 1 - z * z));
  const double azimuth = std::atan2(double(direction.y), double(direction.x));
  // Legendre functions, normalized, by the stable recurrence in the degree (Press et al. 2007, 6.7).
  double diagonal = std::sqrt(1 / (4 * std::numbers::pi));
  for (uint32_t m = 0; m <= order; ++m) {
    if (m > 0) diagonal *= -planar * std::sqrt((2.0 * m + 1) / (2.0 * m));
    double before = 0, now = diagonal;
    for (uint32_t l = m; l <= order; ++l) {
      const double l2 = double(l) * l, m2 = double(m) * m;
      if (l > m) {
        const double a = std::sqrt((4 * l2 - 1) / (l2 - m2));
        const double previous = double(l - 1) * (l - 1);
        const double b = std::sqrt((previous - m2) / (4 * previous - 1));
        const double next = a * (z * now - (l > m + 1 ? b * before : 0));
        before = now;
        now = next;
      }
      const std::size_t middle = std::size_t{l} * (l + 1);
      const double scaled = m == 0 ? now : std::numbers::sqrt2 * now;
      values[middle + m] = float(scaled * std::cos(m * azimuth));
      if (m > 0) values[middle - m] = float(scaled * std::sin(m * azimuth));
    }
  }
  return values;
}

std::vector<VolumeSample> harmonicLayers(IrradianceVolume& base, uint32_t order, float radius,
                                         std::size_t bytes) {
  const std::vector<Direction> directions = directionsOf(base, order);
  const std::size_t count = std::size_t{order + 1} * (order + 1);
  const auto side = std::max(2u, uint32_t(std::cbrt(double(bytes / (kWordsOfCell * sizeof(uint32_t))))));
  const std::size_t cells = std::size_t{side} * side * side;
  SampleLayout layout{vec3(-radius), float(side) / (2 * radius), uvec3(side), uint32_t(cells * kWordsOfCell)};
  std::vector<VolumeSample> layers(count, {layout, std::vector<uint32_t>(layout.words)});
  oneapi::tbb::parallel_for(std::size_t{0}, cells, [&](std::size_t cell) {
    const uvec3 at(cell % side, cell / side % side, cell / (std::size_t{side} * side));
    const vec3 place = layout.corner + (vec3(at) + 0.5f) / layout.placesPerUnit;
    std::vector<vec3> sums(count, vec3(0));
    vec3 color(0);
    for (const Direction& direction : directions) {
      const VolumeLight light = meanAround(direction, place, 1 / layout.placesPerUnit);
      if (light.vector == vec3(0)) continue;
      color += light.color;
      for (std::size_t j = 0; j < count; ++j) sums[j] += direction.harmonics[j] * light.vector;
    }
    for (std::size_t j = 0; j < count; ++j) packCell({sums[j], color}, &layers[j].words[cell * kWordsOfCell]);
  });
  return layers;
}

std::vector<uint32_t> resolveHarmonics(std::span<const std::span<const uint32_t>> layers,
                                       std::span<const float> light) {
  constexpr uint32_t kHalf = 0xffffu;
  std::vector<uint32_t> words(layers[0].size());
  oneapi::tbb::parallel_for(IndexRange(0, words.size() / kWordsOfCell, 256), [&](const IndexRange& range) {
    for (std::size_t cell = range.begin(); cell < range.end(); ++cell) {
      const std::size_t word = cell * kWordsOfCell;
      vec3 sum(0);
      for (std::size_t j = 0; j < layers.size(); ++j) {
        if ((layers[j][word] | (layers[j][word + 1] & kHalf)) == 0) continue;
        const vec2 across = unpackHalf2x16(layers[j][word]);
        sum += light[j] * vec3(across.x, across.y, unpackHalf2x16(layers[j][word + 1]).x);
      }
      words[word] = glm::packHalf2x16(vec2(sum.x, sum.y));
      words[word + 1] = (glm::packHalf2x16(vec2(sum.z, 0)) & kHalf) | (layers[0][word + 1] & ~kHalf);
    }
  });
  return words;
}

}  // namespace nephroid
