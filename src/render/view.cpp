#include "render/view.h"

#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace nephroid {

vec3 uprightFor(const Camera& camera, vec3 forward) {
  return std::abs(dot(forward, normalize(camera.up))) < 0.9999f ? camera.up : vec3(0, 0, -1);
}

View viewOf(const Camera& camera, uvec2 size) {
  View view;
  view.eye = camera.position;
  view.forward = normalize(camera.target - camera.position);
  const float tangent = std::tan(0.5f * glm::radians(camera.verticalFov));
  const vec3 up = uprightFor(camera, view.forward);
  const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
  view.nearest = 1e-4f * distance(camera.target, camera.position);
  view.pixelAngle = 2 * tangent / static_cast<float>(size.y);
  mat4 projection(0);
  projection[0][0] = 1 / (tangent * aspect);
  projection[1][1] = -1 / tangent;
  projection[2][3] = -1;
  projection[3][2] = view.nearest;
  view.worldToClip = projection * glm::lookAtRH(camera.position, camera.target, up);
  return view;
}

View viewAt(const View& view, vec2 place, uvec2 size) {
  View shifted = view;
  shifted.shift = -2.0f * place / vec2(size);
  for (glm::length_t column = 0; column < 4; ++column) {
    shifted.worldToClip[column].x += shifted.shift.x * view.worldToClip[column].w;
    shifted.worldToClip[column].y += shifted.shift.y * view.worldToClip[column].w;
  }
  return shifted;
}

// Without a shift, x and y of clip space are the parts of a ray along two rows of the projection, which stand
// on each other and on the view.
PictureRays raysOf(const View& view) {
  const vec3 x = vec3(glm::row(view.worldToClip, 0)) - view.shift.x * view.forward;
  const vec3 y = vec3(glm::row(view.worldToClip, 1)) - view.shift.y * view.forward;
  const vec3 right = x / dot(x, x), down = y / dot(y, y);
  return {view.forward - view.shift.x * right - view.shift.y * down, right, down};
}

gpu::Region regionOf(const View& view, uvec2 size, const std::array<vec3, 8>& corners) {
  vec2 low(std::numeric_limits<float>::infinity());
  vec2 high = -low;
  int behind = 0;
  for (const vec3 corner : corners) {
    const vec4 clip = view.worldToClip * vec4(corner, 1);
    if (clip.w < view.nearest) {
      ++behind;
      continue;
    }
    const vec2 pixel = (0.5f * vec2(clip) / clip.w + 0.5f) * vec2(size);
    low = glm::min(low, pixel);
    high = glm::max(high, pixel);
  }
  if (behind == 8) return {};
  if (behind > 0) return {{0, 0}, size};
  const vec2 first = glm::clamp(glm::floor(low) - 1.0f, vec2(0), vec2(size));
  const vec2 last = glm::clamp(glm::ceil(high) + 1.0f, vec2(0), vec2(size));
  if (!(first.x < last.x && first.y < last.y)) return {};
  return {ivec2(first), uvec2(last - first)};
}

gpu::Region unionOf(const gpu::Region& a, const gpu::Region& b) {
  if (a.size.x == 0) return b;
  if (b.size.x == 0) return a;
  const ivec2 low = glm::min(a.corner, b.corner);
  const ivec2 high = glm::max(a.corner + ivec2(a.size), b.corner + ivec2(b.size));
  return {low, uvec2(high - low)};
}

}  // namespace nephroid
