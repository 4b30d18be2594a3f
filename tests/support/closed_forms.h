// Where light goes that glass and mirrors of simple shapes send on, by the formulas of textbooks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <vector>

namespace nephroid {

// Part of the light reflected by glass; `eta`: the index on this side over that beyond.
inline double fresnel(double cosIncident, double eta) {
  const double sine = eta * std::sqrt(std::max(0.0, 1 - cosIncident * cosIncident));
  if (sine >= 1) return 1;
  const double cosTransmitted = std::sqrt(1 - sine * sine);
  const double perpendicular = (eta * cosIncident - cosTransmitted) / (eta * cosIncident + cosTransmitted);
  const double parallel = (cosIncident - eta * cosTransmitted) / (cosIncident + eta * cosTransmitted);
  return (perpendicular * perpendicular + parallel * parallel) / 2;
}

// Lumens on rings of a floor around the axis of a glass ball under a vertical sun of 1 lux, reflections left
// out. Light that comes in at a distance from the axis is turned by twice (incidence - refraction). `height`
// (m) of the ball's center over the floor.
inline std::vector<double> ballLensRings(double radius, double height, double ior, double ringWidth,
                                         std::size_t rings) {
  constexpr int kSteps = 400000;
  std::vector<double> flux(rings, 0.0);
  for (int i = 0; i < kSteps; ++i) {
    const double fromAxis = (i + 0.5) / kSteps * radius;
    const double incidence = std::asin(fromAxis / radius), refraction = std::asin(fromAxis / radius / ior);
    const double transmitted = 1 - fresnel(std::cos(incidence), 1 / ior);
    const double exitAngle = 2 * refraction - incidence;  // from the axis, on the far side
    const double exitY = height - radius * std::cos(exitAngle);
    const double landing =
        std::abs(radius * std::sin(exitAngle) - exitY * std::tan(2 * (incidence - refraction)));
    const auto ring = std::size_t(landing / ringWidth);
    if (ring < rings)
      flux[ring] += 2 * std::numbers::pi * fromAxis * (radius / kSteps) * transmitted * transmitted;
  }
  return flux;
}

// Light of a sun of 1 lux, which travels along +x and down at `elevation` (radians), reflected by the inner
// wall of a mirror ring around the y axis that stands on the floor: calls land(x, z, lumens) for each of many
// parts. Seen from above it runs through a circle as in billiards.
inline void followMirrorRing(double radius, double height, double elevation, double reflectance,
                             const std::function<void(double, double, double)>& land) {
  constexpr int kAngles = 2000, kHeights = 1000;
  const double slope = std::tan(elevation);
  for (int i = 0; i < kAngles; ++i) {
    const double first = std::numbers::pi * ((i + 0.5) / kAngles - 0.5);  // on the wall, from +x
    const double chord = 2 * radius * std::cos(first);
    for (int j = 0; j < kHeights; ++j) {
      const double y = height * (j + 0.5) / kHeights;
      if (y + chord * slope < height) continue;  // in the shadow of the wall before
      double lumens = reflectance * std::cos(elevation) * std::cos(first) * radius * std::numbers::pi /
                      kAngles * height / kHeights;
      double angle = first, heading = 2 * first + std::numbers::pi, left = y / slope;
      for (; left > chord; left -= chord) {
        angle = 2 * heading - angle - std::numbers::pi;
        heading = 2 * angle + std::numbers::pi - heading;
        lumens *= reflectance;
      }
      land(radius * std::cos(angle) + left * std::cos(heading),
           radius * std::sin(angle) + left * std::sin(heading), lumens);
    }
  }
}

// The angle (radians) that a prism turns light by which comes in at `incidence`.
inline double prismDeviation(double apex, double ior, double incidence) {
  const double inside = apex - std::asin(std::sin(incidence) / ior);
  return incidence + std::asin(ior * std::sin(inside)) - apex;
}

}  // namespace nephroid
