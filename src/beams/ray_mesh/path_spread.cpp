#include "beams/ray_mesh/path_spread.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid {
namespace {

// Radians for all of a lamp: what turns more, after many boundaries, does not turn in proportion.
constexpr float kMostTurn = 2;

void boundTurns(PathSpread& spread) {
  for (vec3& turn : spread.direction) turn *= std::min(1.0f, kMostTurn / std::max(length(turn), 1e-30f));
}

}  // namespace

PathSpread firstSpread(const LampSpread& lamp, bool isFromAfar, vec3 direction, float length) {
  PathSpread spread;
  const std::array<vec3, 2> axes = lamp.axesAcross(direction);
  for (int i = 0; i < 2; ++i) {
    const vec3 across = axes[i] - dot(axes[i], direction) * direction;
    spread.direction[i] = isFromAfar ? across : -across / std::max(length, 1e-30f);
  }
  return spread;
}

void reflectSpread(const PathSpread& before, vec3 direction, vec3 normal, PathSpread& after) {
  const float along = dot(direction, normal);
  for (int i = 0; i < 2; ++i) {
    const vec3 turn = before.normal[i];
    const float change = dot(before.direction[i], normal) + dot(direction, turn);
    after.direction[i] = before.direction[i] - 2.0f * (change * normal + along * turn);
  }
  boundTurns(after);
}

void refractSpread(const PathSpread& before, vec3 direction, vec3 normal, float eta, PathSpread& after) {
  constexpr float kLeastCosine = 0.05f;  // at the border of total reflection it has no end
  const float incident = -dot(direction, normal);
  const float squared = 1 - eta * eta * (1 - incident * incident);
  const float transmitted = std::sqrt(std::max(squared, kLeastCosine * kLeastCosine));
  for (int i = 0; i < 2; ++i) {
    const vec3 turn = before.normal[i];
    const float change = -(dot(before.direction[i], normal) + dot(direction, turn));
    const float bend = eta * change - eta * eta * incident * change / transmitted;
    after.direction[i] = eta * before.direction[i] + bend * normal + (eta * incident - transmitted) * turn;
  }
  boundTurns(after);
}

void carrySpread(const PathSpread& before, vec3 direction, float length, vec3 normal, PathSpread& after) {
  constexpr float kLeastCosine = 0.05f;  // light that grazes a surface moves along it without end
  const float along = dot(direction, normal);
  const float cosine = std::copysign(std::max(std::abs(along), kLeastCosine), along);
  for (int i = 0; i < 2; ++i) {
    const vec3 moved = before.position[i] + length * after.direction[i];
    after.position[i] = moved - dot(moved, normal) / cosine * direction;
  }
}

void turnNormals(const mat3& corners, const mat3& normals, vec3 at, PathSpread& spread) {
  const vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
  const vec3 across = cross(u, v);
  const float scale = 1 / std::max(dot(across, across), 1e-30f);
  const vec3 smooth = normals * at;
  const float size = std::max(length(smooth), 1e-6f);
  const vec3 unit = smooth / size;
  for (int i = 0; i < 2; ++i) {
    const float b = dot(cross(spread.position[i], v), across) * scale;
    const float c = dot(cross(u, spread.position[i]), across) * scale;
    const vec3 turn = (b * (normals[1] - normals[0]) + c * (normals[2] - normals[0])) / size;
    spread.normal[i] = turn - dot(turn, unit) * unit;
  }
}

}  // namespace nephroid
