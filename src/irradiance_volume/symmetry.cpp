#include "irradiance_volume/symmetry.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace nephroid {
namespace {

constexpr int kRays = 400;
constexpr float kDistanceTolerance = 2e-3f;  // bounding radii
constexpr float kNormalTolerance = 0.998f;   // cosine of 3.6 degrees
constexpr int kMostDifferent = kRays / 50;   // rays that graze an edge

vec3 randomDirection(Random& random) {
  const float z = 2 * random.uniform() - 1;
  const float azimuth = 6.2831853f * random.uniform();
  const float planar = std::sqrt(std::max(0.0f, 1 - z * z));
  return {planar * std::cos(azimuth), planar * std::sin(azimuth), z};
}

bool meetsAlike(const RayScene& rays, const Sphere& sphere, const mat3& transform, vec3 origin, vec3 target) {
  const vec3 direction = normalize(target - origin);
  Hit hit, image;
  const bool meets = rays.intersect({sphere.center + sphere.radius * origin, direction}, hit);
  const bool imageMeets =
      rays.intersect({sphere.center + sphere.radius * (transform * origin), transform * direction}, image);
  if (meets != imageMeets) return false;
  return !meets || (std::abs(hit.distance - image.distance) < kDistanceTolerance * sphere.radius &&
                    dot(transform * hit.normal, image.normal) > kNormalTolerance);
}

bool isKeptBy(const RayScene& rays, const Sphere& sphere, const mat3& transform) {
  Random random(1);
  int different = 0;
  for (int i = 0; i < kRays && different <= kMostDifferent; ++i) {
    const vec3 origin = 2.0f * randomDirection(random);
    const vec3 target = std::cbrt(random.uniform()) * randomDirection(random);
    if (!meetsAlike(rays, sphere, transform, origin, target)) ++different;
  }
  return different <= kMostDifferent;
}

mat3 turn(vec3 axis, float angle) {
  return glm::mat3_cast(glm::angleAxis(angle, normalize(axis)));
}

vec3 unitAxis(int axis) {
  vec3 unit(0);
  unit[axis] = 1;
  return unit;
}

mat3 mirror(int axis) {
  mat3 matrix(1);
  matrix[axis][axis] = -1;
  return matrix;
}

}  // namespace

Symmetry findSymmetry(const RayScene& rays, const Sphere& sphere) {
  // Angles that no regular polygon is kept by.
  const auto isKeptByTurns = [&](vec3 axis) {
    return isKeptBy(rays, sphere, turn(axis, 1.0f)) && isKeptBy(rays, sphere, turn(axis, 2.3f));
  };
  Symmetry symmetry;
  for (int axis = 0; axis < 3; ++axis) symmetry.mirrors[axis] = isKeptBy(rays, sphere, mirror(axis));
  for (uint32_t axis = 0; axis < 3 && symmetry.axis == 3; ++axis)
    if (isKeptByTurns(unitAxis(int(axis)))) symmetry.axis = axis;
  symmetry.isBall = symmetry.axis == 0 && isKeptByTurns(vec3(0, 1, 0)) && isKeptByTurns(vec3(1, 2, 3));
  return symmetry;
}

}  // namespace nephroid
