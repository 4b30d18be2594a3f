#include "reference/pinhole.h"

#include <cmath>

namespace nephroid {

Pinhole::Pinhole(const Camera& camera, uvec2 pictureSize) : eye(camera.position), size(pictureSize) {
  const vec3 forward = normalize(camera.target - camera.position);
  const vec3 up = std::abs(dot(forward, normalize(camera.up))) < 0.9999f ? camera.up : vec3(0, 0, -1);
  const vec3 right = normalize(cross(forward, up));
  frame = {right, cross(right, forward), forward};
  height = std::tan(0.5f * glm::radians(camera.verticalFov));
  width = height * float(size.x) / float(size.y);
}

Ray Pinhole::rayThrough(vec2 place) const {
  const vec2 at = 2.0f * place / vec2(size) - 1.0f;
  return {eye, normalize(frame[2] + at.x * width * frame[0] - at.y * height * frame[1])};
}

std::optional<Pinhole::Projection> Pinhole::project(vec3 place) const {
  const vec3 offset = place - eye;
  const vec3 local = glm::transpose(frame) * offset;
  if (local.z <= 0) return std::nullopt;
  const vec2 at =
      (vec2(local.x / (local.z * width), -local.y / (local.z * height)) + 1.0f) * 0.5f * vec2(size);
  if (!(at.x >= 0 && at.y >= 0 && at.x < float(size.x) && at.y < float(size.y))) return std::nullopt;
  Projection seen;
  seen.pixel = uint32_t(at.y) * size.x + uint32_t(at.x);
  seen.distance = length(offset);
  seen.direction = -offset / seen.distance;
  // A pixel is a rectangle a metre before the camera; the picture is the mean over it.
  const float cosine = local.z / seen.distance;
  const float pixelArea = 4 * width * height / (float(size.x) * float(size.y));  // m2
  seen.perSteradian = 1 / (pixelArea * cosine * cosine * cosine);
  return seen;
}

}  // namespace nephroid
