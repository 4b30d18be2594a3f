#include "viewer/camera_control.h"

#include <algorithm>
#include <cmath>

namespace nephroid {
namespace {

// Below the 87.4 degrees from which upFor turns to -Z.
const float kSteepest = glm::radians(87.0f);

struct Angles {
  float around = 0;  // radians about +Y; 0 along +Z
  float above = 0;   // radians over the horizon
};

// Of a direction of any length; where it is vertical, `up` tells which way it came from.
Angles anglesOf(vec3 direction, vec3 up) {
  const vec3 unit = normalize(direction);
  const vec3 level = std::abs(unit.y) > 0.9999f ? (unit.y > 0 ? -up : up) : unit;
  return {std::atan2(level.x, level.z), std::asin(glm::clamp(unit.y, -1.0f, 1.0f))};
}

vec3 directionOf(const Angles& angles) {
  const float level = std::cos(angles.above);
  return {level * std::sin(angles.around), std::sin(angles.above), level * std::cos(angles.around)};
}

Angles turned(const Angles& angles, vec2 turn) {
  return {angles.around + turn.x, glm::clamp(angles.above + turn.y, -kSteepest, kSteepest)};
}

}  // namespace

void orbit(Camera& camera, vec2 turn) {
  const vec3 offset = camera.position - camera.target;
  camera.position = camera.target + length(offset) * directionOf(turned(anglesOf(offset, camera.up), turn));
  camera.up = {0, 1, 0};
}

void look(Camera& camera, vec2 turn) {
  const vec3 offset = camera.target - camera.position;
  camera.target =
      camera.position + length(offset) * directionOf(turned(anglesOf(offset, -camera.up), {-turn.x, turn.y}));
  camera.up = {0, 1, 0};
}

void pan(Camera& camera, vec2 pixels, float height) {
  const vec3 forward = camera.target - camera.position;
  const vec3 right = normalize(cross(forward, camera.up));
  const vec3 up = normalize(cross(right, forward));
  const float metersPerPixel =
      2 * length(forward) * std::tan(0.5f * glm::radians(camera.verticalFov)) / height;
  const vec3 move = metersPerPixel * (-pixels.x * right + pixels.y * up);
  camera.position += move;
  camera.target += move;
}

void zoom(Camera& camera, float steps) {
  const float factor = std::pow(0.875f, glm::clamp(steps, -32.0f, 32.0f));
  camera.position = camera.target + factor * (camera.position - camera.target);
}

void fly(Camera& camera, vec3 meters) {
  const vec3 forward = normalize(camera.target - camera.position);
  const vec3 right = normalize(cross(forward, camera.up));
  const vec3 move = meters.x * right + meters.y * vec3(0, 1, 0) + meters.z * forward;
  camera.position += move;
  camera.target += move;
}

void frameBox(Camera& camera, const Box& box) {
  const vec3 forward = normalize(camera.target - camera.position);
  const float radius = std::max(0.5f * box.diagonal(), 1e-4f);
  camera.target = box.center();
  camera.position = camera.target - radius / std::sin(0.5f * glm::radians(camera.verticalFov)) * forward;
}

}  // namespace nephroid
