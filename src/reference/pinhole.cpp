#include "reference/pinhole.h"

#include <cmath>

namespace nephroid {

Pinhole::Pinhole(const Camera& camera, uvec2 pictureSize) : eye_(camera.position), size_(pictureSize) {
  const vec3 forward = normalize(camera.target - camera.position);
  const vec3 up = std::abs(dot(forward, normalize(camera.up))) < 0.9999f ? camera.up : vec3(0, 0, -1);
  const vec3 right = normalize(cross(forward, up));
  frame_ = {right, cross(right, forward), forward};
  height_ = std::tan(0.5f * glm::radians(camera.verticalFov));
  width_ = height_ * float(size_.x) / float(size_.y);
}

Ray Pinhole::rayThrough(vec2 place) const {
  const vec2 at = 2.0f * place / vec2(size_) - 1.0f;
  return {eye_, normalize(frame_[2] + at.x * width_ * frame_[0] - at.y * height_ * frame_[1])};
}

std::optional<Pinhole::Projection> Pinhole::project(vec3 place, float margin) const {
  const vec3 offset = place - eye_;
  const vec3 local = glm::transpose(frame_) * offset;
  if (local.z <= 0) return std::nullopt;
  const vec2 at =
      (vec2(local.x / (local.z * width_), -local.y / (local.z * height_)) + 1.0f) * 0.5f * vec2(size_);
  if (!glm::all(glm::greaterThanEqual(at, vec2(-margin))) ||
      !glm::all(glm::lessThan(at, vec2(size_) + margin)))
    return std::nullopt;
  Projection seen;
  seen.place = at;
  seen.distance = length(offset);
  seen.direction = -offset / seen.distance;
  // A pixel is a rectangle a meter before the camera; the picture is the mean over it.
  const float cosine = local.z / seen.distance;
  const float pixelArea = 4 * width_ * height_ / (float(size_.x) * float(size_.y));  // m2
  seen.perSteradian = 1 / (pixelArea * cosine * cosine * cosine);
  return seen;
}

}  // namespace nephroid
