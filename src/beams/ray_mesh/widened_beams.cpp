#include "beams/ray_mesh/widened_beams.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

using glm::mat2;
namespace {

// Standard deviations of the lamp's image, over the detail: that are not seen, and that are hardly seen.
constexpr float kUnseenBlur = 0.15f, kSmallBlur = 0.6f;
// Of the standard deviation, the size of beams of which there are many in a lamp's image.
constexpr float kSmallBeam = 0.15f;
constexpr std::size_t kMixed = 8;  // of the many places, that such a beam uses
// Of the variance of what a place stands for, what its beam is smeared by is not taken from that of the
// places: the middle of the lamp's image stays as bright as it is.
constexpr float kNotTaken = 0.5f;

// Across the plane of a triangle.
struct Plane {
  vec3 u{0}, v{0};
  vec2 across(vec3 w) const { return {dot(w, u), dot(w, v)}; }
};

Plane planeAcross(vec3 normal) {
  const vec3 aside = std::abs(normal.x) < 0.6f ? vec3(1, 0, 0) : vec3(0, 1, 0);
  const vec3 u = normalize(cross(normal, aside));
  return {u, cross(normal, u)};
}

// By its eigenvalues' roots; of a symmetric matrix without negative ones.
mat2 rootOf(const mat2& m) {
  const float root = std::sqrt(std::max(determinant(m), 0.0f));
  const float scale = std::sqrt(std::max(m[0][0] + m[1][1] + 2 * root, 1e-30f));
  return (m + mat2(root)) / scale;
}

// The turn, perhaps with a mirror, nearest to a matrix.
mat2 turnOf(const mat2& m) {
  const float sign = determinant(m) < 0 ? -1.0f : 1.0f;
  const mat2 sum = m + sign * mat2(m[1][1], -m[1][0], -m[0][1], m[0][0]);
  const float size = std::hypot(sum[0][0], sum[0][1]);
  return size > 0 ? sum / size : mat2(1);
}

// Moves the corners of a triangle so that the variance of what it covers grows by `variance`, as little as
// that takes.
void smear(const Plane& plane, const mat2& variance, vec3 (&corner)[3]) {
  // Corners of a triangle whose variance along each axis is 1.
  constexpr float kRoot2 = 1.41421356f, kRoot6 = 2.44948974f;
  constexpr vec2 kEven[3] = {{0, 2 * kRoot2}, {-kRoot6, -kRoot2}, {kRoot6, -kRoot2}};
  const vec3 middle = (corner[0] + corner[1] + corner[2]) / 3.0f;
  mat2 shape(0);  // that makes the triangle of the even one
  for (int c = 0; c < 3; ++c) shape += outerProduct(plane.across(corner[c] - middle), kEven[c]) / 12.0f;
  const mat2 root = rootOf(shape * transpose(shape) + variance);
  const mat2 larger = root * turnOf(root * shape);
  for (int c = 0; c < 3; ++c) {
    const vec2 place = larger * kEven[c];
    corner[c] = middle + place.x * plane.u + place.y * plane.v;
  }
}

// Where a corner lands for a place on the lamp: where its way meets the receiver's plane, since it moves far
// out there where it meets the plane at a slant; in proportion where it would hardly meet it.
vec3 movedCorner(vec3 corner, const BeamShift& shift, int c, vec2 at, vec3 normal) {
  constexpr float kLeastApproach = 0.3f;  // of what it was
  const vec3 start = shift.start[c] + at.x * shift.startShift[c][0] + at.y * shift.startShift[c][1];
  const vec3 direction =
      normalize(shift.direction[c] + at.x * shift.directionShift[c][0] + at.y * shift.directionShift[c][1]);
  const float before = dot(shift.direction[c], normal), approach = dot(direction, normal);
  if (!(approach / before >= kLeastApproach && before != 0))
    return corner + at.x * shift.corner[c][0] + at.y * shift.corner[c][1];
  return start + dot(corner - start, normal) / approach * direction;
}

}  // namespace

BeamCopies copiesFor(float blur, float detail, float longest, bool isOneOfMore) {
  if (blur < kUnseenBlur * detail) return {};
  // Of a lamp of many parts there are so many small beams that each may have one of the places.
  if (longest < kSmallBeam * blur) return {isOneOfMore ? 1 : kMixed, true};
  return {isOneOfMore || blur < kSmallBlur * detail ? kFewLampPlaces : kLampPlaces, false};
}

void widen(const LandedBeam& beam, const BeamShift& shift, const LampSpread& lamp, vec3 normal,
           std::optional<std::size_t> number, std::span<LandedBeam> beams) {
  const std::size_t count = beams.size(), stride = kManyLampPlaces / count;
  const Plane plane = planeAcross(normal);
  const float rest = lamp.restOf(number ? kLampPlaces : count);
  mat2 variance(0);
  for (int i = 0; i < 2; ++i) {
    const vec2 mean = plane.across(shift.corner[0][i] + shift.corner[1][i] + shift.corner[2][i]) / 3.0f;
    variance += rest * outerProduct(mean, mean);
  }
  for (std::size_t k = 0; k < count; ++k) {
    LandedBeam& part = beams[k] = beam;
    part.flux /= float(count);
    const vec2 place = number                 ? lamp.manyPlaces[k * stride + *number % stride]
                       : count == kLampPlaces ? lamp.places[k]
                                              : lamp.fewPlaces[k];
    const vec2 at = std::sqrt(1 - (1 - kNotTaken) * rest) * place;
    for (int c = 0; c < 3; ++c) part.corner[c] = movedCorner(beam.corner[c], shift, c, at, normal);
    smear(plane, variance, part.corner);
  }
}

}  // namespace nephroid
