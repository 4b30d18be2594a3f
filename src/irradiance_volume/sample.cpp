#include "irradiance_volume/sample.h"

#include <algorithm>

namespace nephroid {

VolumeLight lightAt(const SampleLayout& layout, std::span<const uint32_t> words, uint32_t representation,
                    vec3 place, const LightFlow& flow) {
  return flowedLight({layout.size, words.data()}, representation, viewOf(flow),
                     (place - layout.corner) * layout.placesPerUnit);
}

vec3 spreadSource(std::span<const PhotonPath> paths, float radius) {
  constexpr float kFarAway = -20;  // radii of the region, along the light: as good as parallel
  constexpr double kWeightOfFarAway = 1e-5;
  glm::dmat3 across(0);
  glm::dvec3 sum(0);
  double weights = 0;
  for (const PhotonPath& path : paths) {
    const glm::dvec3 end = (path.origin + path.length * path.direction) / radius;
    if (dot(end, end) < 0.99) continue;
    const glm::dvec3 direction(path.direction);
    const double weight = double(path.flux.x + path.flux.y + path.flux.z);
    const glm::dmat3 projection = glm::dmat3(1) - glm::outerProduct(direction, direction);
    across += weight * projection;
    sum += weight * (projection * end);
    weights += weight;
  }
  if (weights <= 0) return vec3(0);
  const double prior = kWeightOfFarAway * weights;
  return vec3(glm::inverse(across + glm::dmat3(prior)) * (sum + prior * glm::dvec3(0, 0, kFarAway)));
}

void packCell(const CellSum& cell, uint32_t* words) {
  constexpr float kLargestHalf = 65504.0f;
  const vec3 vector = clamp(cell.vector, vec3(-kLargestHalf), vec3(kLargestHalf));
  const float sum = cell.color.x + cell.color.y + cell.color.z;
  const vec3 parts = sum > 0 ? cell.color / sum : vec3(1 / 3.0f);
  const auto red = uint32_t(255 * parts.x + 0.5f);
  const auto blue = std::min(uint32_t(255 * parts.z + 0.5f), 255 - red);
  words[0] = glm::packHalf2x16(vec2(vector.x, vector.y));
  words[1] = glm::packHalf2x16(vec2(vector.z, 0)) | red << 16 | blue << 24;
}

}  // namespace nephroid
