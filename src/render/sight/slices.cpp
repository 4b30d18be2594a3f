#include "render/sight/slices.h"

#include <algorithm>
#include <cmath>

namespace nephroid {
namespace {

// Between planes the depth grows by no more than this factor when their number is not given.
constexpr float kDepthRatio = 2;
constexpr uint32_t kMostAutomaticSlices = 6;
// Tangents of half the opening: a wider view wastes texels on the rim of the caster, where it reflects more
// than it lets through.
constexpr float kLeastTangent = 0.2f;
constexpr float kMostTangent = 2.5f;
constexpr float kSightInside = 0.98f;  // the part of the view rays within the opening

// How much of the picture, by what is left of its light, looks one way.
struct Part {
  float weight = 0;
  vec3 direction{0};  // unit
};

std::vector<Part> partsOf(const SightMesh& sight) {
  std::vector<Part> parts;
  parts.reserve(sight.indices.size() / 3);
  for (std::size_t i = 0; i + 2 < sight.indices.size(); i += 3) {
    const SightVertex &a = sight.vertices[sight.indices[i]], &b = sight.vertices[sight.indices[i + 1]],
                      &c = sight.vertices[sight.indices[i + 2]];
    const vec3 transmittance = a.transmittance + b.transmittance + c.transmittance;
    const float area = length(cross(b.position - a.position, c.position - a.position));  // m2, twice
    const vec3 direction = a.direction + b.direction + c.direction;
    const float norm = length(direction);
    if (norm > 0)
      parts.push_back({area * (transmittance.x + transmittance.y + transmittance.z), direction / norm});
  }
  return parts;
}

float tangentFrom(vec3 axis, vec3 direction) {
  const float along = dot(axis, direction);
  return along > 0 ? length(direction - along * axis) / along : kMostTangent;
}

// The tangent of the cone around `axis` that holds most of the view rays, with a small margin.
float openingOf(const std::vector<Part>& parts, vec3 axis) {
  constexpr std::size_t kBins = 128;
  std::array<float, kBins + 1> weights{};
  float all = 0;
  for (const Part& part : parts) {
    const float tangent = std::min(tangentFrom(axis, part.direction), kMostTangent);
    weights[std::size_t(tangent / kMostTangent * float(kBins))] += part.weight;
    all += part.weight;
  }
  std::size_t bin = 0;
  for (float inside = weights[0]; inside < kSightInside * all && bin < kBins;) inside += weights[++bin];
  const float tangent = 1.1f * kMostTangent * float(bin + 1) / float(kBins);
  return glm::clamp(tangent, kLeastTangent, kMostTangent);
}

SightFrame frameAlong(vec3 axis, vec3 apex, float tangent) {
  SightFrame frame;
  frame.apex = apex;
  frame.axisW = axis;
  const vec3 up = std::abs(axis.y) < 0.99f ? vec3(0, 1, 0) : vec3(1, 0, 0);
  frame.axisU = normalize(cross(axis, up));
  frame.axisV = cross(axis, frame.axisU);
  frame.scale = 1 / tangent;
  return frame;
}

// m along the frame's axis: where the first sight leaves the caster.
float firstExit(const SightMesh& sight, const SightFrame& frame, float radius) {
  float first = 2 * radius;
  for (const uint32_t i : sight.indices)
    first = std::min(first, dot(sight.vertices[i].exit - frame.apex, frame.axisW));
  return std::max(first, 0.1f * radius);
}

}  // namespace

vec2 depthsIn(const SightFrame& frame, const ReceiverBounds& receiver) {
  vec2 depths(std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity());
  for (const vec3 corner : receiver.corners) {
    const float depth = dot(corner - frame.apex, frame.axisW);
    depths = {std::min(depths.x, depth), std::max(depths.y, depth)};
  }
  return depths;
}

bool isSeen(const SightFrame& frame, vec2 depths, const ReceiverBounds& receiver) {
  const vec2 own = depthsIn(frame, receiver);
  if (own.y < depths.x || own.x > depths.y) return false;
  // Off to one side of the opening with all corners.
  for (const vec3 side : {frame.axisU, -frame.axisU, frame.axisV, -frame.axisV})
    if (std::ranges::all_of(receiver.corners, [&](vec3 corner) {
          const vec3 fromApex = corner - frame.apex;
          return frame.scale * dot(fromApex, side) > dot(fromApex, frame.axisW);
        }))
      return false;
  return true;
}

SliceSet planSlices(const SightMesh& sight, vec3 center, float radius,
                    std::span<const ReceiverBounds> receivers, uint32_t count) {
  SliceSet set{};
  const std::vector<Part> parts = partsOf(sight);
  vec3 mean(0);
  for (const Part& part : parts) mean += part.weight * part.direction;
  if (!(length(mean) > 0)) return set;
  const vec3 axis = normalize(mean);
  set.frame = frameAlong(axis, center - radius * axis, openingOf(parts, axis));
  set.firstDepth = firstExit(sight, set.frame, radius);
  float farthest = 0;
  for (const ReceiverBounds& receiver : receivers)
    farthest = std::max(farthest, depthsIn(set.frame, receiver).y);
  farthest *= 1.001f;
  if (farthest <= set.firstDepth) return set;
  const float octaves = std::log(farthest / set.firstDepth) / std::log(kDepthRatio);
  set.slices = count > 0 ? std::min(count, kMostSlices)
                         : glm::clamp(uint32_t(std::ceil(octaves)), 1u, kMostAutomaticSlices);
  set.depthRatio = std::pow(farthest / set.firstDepth, 1 / float(set.slices));
  float depth = set.firstDepth;
  for (uint32_t i = 0; i < set.slices; ++i, depth *= set.depthRatio)
    if (std::ranges::any_of(receivers, [&](const ReceiverBounds& receiver) {
          return isSeen(set.frame, {depth, depth * set.depthRatio}, receiver);
        }))
      set.occupied |= 1u << i;
  return set;
}

}  // namespace nephroid
