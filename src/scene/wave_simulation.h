// The wave equation u_tt + damping u_t = c^2 (u_xx + u_zz) on a grid, by central differences in time and
// space; its sides send waves back (no slope across them).
#pragma once

#include <vector>

#include "scene/scene.h"

namespace nephroid {

inline bool operator==(const WaterDrop& a, const WaterDrop& b) {
  return a.time == b.time && a.position == b.position && a.radius == b.radius && a.depth == b.depth;
}

struct WaveField {
  uvec2 grid{2, 2};
  glm::dvec2 spacing{1};        // m
  double speed = 1;             // m/s
  double damping = 0;           // 1/s
  double step = 0;              // s, from `before` to `heights`; at most stableStep
  std::vector<double> heights;  // m, x fastest
  std::vector<double> before;
};

// s; longer steps make waves grow without end.
double stableStep(glm::dvec2 spacing, double speed);

void advance(WaveField& field);

// What advance keeps where there is no damping: kinetic and potential energy, J per kg/m2 of water set in
// motion.
double energy(const WaveField& field);

// Steps of the simulation up to `time`, s.
double simulationSteps(const Water& water, double time);

// m, at the vertices of the water's grid; still before time 0.
std::vector<double> simulatedHeights(const Water& water, double time);

}  // namespace nephroid
