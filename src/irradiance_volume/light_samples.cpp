#include "irradiance_volume/light_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "transport/table/directions.h"

namespace nephroid {
namespace {

constexpr float kIcosahedronEdge = 1.1071487f;  // radians between neighboring vertices

// Mirrors to the positive side of every mirror plane.
mat3 toPositiveSide(const Symmetry& symmetry, vec3 direction) {
  mat3 matrix(1);
  for (int axis = 0; axis < 3; ++axis)
    if (symmetry.mirrors[axis] && direction[axis] < 0) matrix[axis][axis] = -1;
  return matrix;
}

bool isOnPositiveSide(const Symmetry& symmetry, vec3 direction) {
  constexpr float kOnPlane = 1e-4f;  // vertices on a mirror plane are as much on either side
  for (int axis = 0; axis < 3; ++axis)
    if (symmetry.mirrors[axis] && direction[axis] < -kOnPlane) return false;
  return true;
}

vec3 onCircle(uint32_t axis, float angle) {
  vec3 direction(0);
  direction[int(axis)] = std::cos(angle);
  direction[int((axis + 1) % 3)] = std::sin(angle);
  return direction;
}

float circleLength(const Symmetry& symmetry) {
  return symmetry.mirrors[symmetry.axis] ? 0.5f * std::numbers::pi_v<float> : std::numbers::pi_v<float>;
}

void keepNearest(std::vector<SampleShare>& shares) {
  const SampleShare nearest =
      *std::max_element(shares.begin(), shares.end(),
                        [](const SampleShare& a, const SampleShare& b) { return a.weight < b.weight; });
  shares.assign(1, nearest);
  shares[0].weight = 1;
}

}  // namespace

mat3 sampleFrame(vec3 lightDirection) {
  return vertexFrame(lightDirection);
}

mat3 turnBetween(vec3 from, vec3 to) {
  const float cosine = dot(from, to);
  if (cosine < -0.99999f) {  // half a turn about any axis across
    const vec3 across = vertexFrame(from)[0];
    return glm::mat3_cast(glm::angleAxis(std::numbers::pi_v<float>, across));
  }
  const vec3 axis = cross(from, to);
  return glm::mat3_cast(glm::normalize(quat(1 + cosine, axis.x, axis.y, axis.z)));
}

LightSamples::LightSamples(const Symmetry& symmetry, uint32_t level)
    : symmetry_(symmetry), halfStep_(0.5f * kIcosahedronEdge / float(1u << level)) {
  if (symmetry.isBall) {
    directions_ = {vec3(0, -1, 0)};
  } else if (symmetry.axis < 3) {
    const auto steps = uint32_t(std::ceil(circleLength(symmetry) / (2 * halfStep_)));
    for (uint32_t i = 0; i <= steps; ++i)
      directions_.push_back(onCircle(symmetry.axis, circleLength(symmetry) * float(i) / float(steps)));
  } else {
    sphere_ = std::make_unique<LightSphere>(level);
    std::vector<uint32_t> kept(sphere_->directions().size());
    for (std::size_t i = 0; i < kept.size(); ++i) {
      kept[i] = uint32_t(directions_.size());
      if (isOnPositiveSide(symmetry, sphere_->directions()[i]))
        directions_.push_back(sphere_->directions()[i]);
    }
    for (const vec3& direction : sphere_->directions()) {
      const DirectionTriangle image = sphere_->around(toPositiveSide(symmetry, direction) * direction);
      const auto heaviest = std::max_element(image.weight.begin(), image.weight.end());
      sampleOf_.push_back(kept[image.vertex[std::size_t(heaviest - image.weight.begin())]]);
    }
  }
}

std::vector<SampleShare> LightSamples::aroundCircle(vec3 direction) const {
  const auto axis = int(symmetry_.axis);
  const auto first = int((symmetry_.axis + 1) % 3);
  const auto second = int((symmetry_.axis + 2) % 3);
  vec3 unit(0);
  unit[axis] = 1;
  const float azimuth = std::atan2(direction[second], direction[first]);
  mat3 toCircle = glm::mat3_cast(glm::angleAxis(-azimuth, unit));
  if (symmetry_.mirrors[axis] && direction[axis] < 0) {
    mat3 mirrored(1);
    mirrored[axis][axis] = -1;
    toCircle = mirrored * toCircle;
  }
  const vec3 onIt = toCircle * direction;
  const float angle = std::atan2(std::max(onIt[first], 0.0f), onIt[axis]);
  const auto steps = uint32_t(directions_.size() - 1);
  const float place = std::clamp(angle / circleLength(symmetry_), 0.0f, 1.0f) * float(steps);
  const uint32_t before = std::min(uint32_t(place), steps - 1);
  const float part = place - float(before);
  return {{before, 1 - part, toCircle}, {before + 1, part, toCircle}};
}

std::vector<SampleShare> LightSamples::aroundSphere(vec3 direction) const {
  const DirectionTriangle triangle = sphere_->around(direction);
  std::vector<SampleShare> shares;
  for (int i = 0; i < 3; ++i) {
    const uint32_t vertex = triangle.vertex[std::size_t(i)];
    shares.push_back({sampleOf_[vertex], triangle.weight[std::size_t(i)],
                      toPositiveSide(symmetry_, sphere_->directions()[vertex])});
  }
  return shares;
}

std::vector<SampleShare> LightSamples::around(vec3 direction, LightInterpolation interpolation) const {
  if (symmetry_.isBall) return {{0, 1, turnBetween(direction, directions_[0])}};
  std::vector<SampleShare> shares = symmetry_.axis < 3 ? aroundCircle(direction) : aroundSphere(direction);
  if (interpolation == LightInterpolation::nearest) keepNearest(shares);
  if (interpolation == LightInterpolation::rotated || interpolation == LightInterpolation::flow)
    for (SampleShare& share : shares) {
      const vec3 light = share.toSample * direction;
      if (interpolation == LightInterpolation::flow)
        share.aside = vec2(glm::transpose(sampleFrame(directions_[share.sample])) * light);
      share.toSample = turnBetween(light, directions_[share.sample]) * share.toSample;
    }
  std::erase_if(shares, [](const SampleShare& share) { return share.weight <= 0; });
  return shares;
}

}  // namespace nephroid
