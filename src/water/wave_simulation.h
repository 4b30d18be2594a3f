// The wave equation u_tt + damping u_t = c^2 (u_xx + u_zz) on a grid, by central differences in time and
// space; its sides send waves back (no slope across them).
#pragma once

#include <map>
#include <vector>

#include "water/water.h"

namespace nephroid {

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

// A simulation that is asked for one time after another, with what it came to the last time.
class WaveRun {
 public:
  // As simulatedHeights, to the last bit. Goes on from the last time it was asked for, unless that is past
  // `time` or the water has since changed in what it did up to there.
  std::vector<double> heightsAt(const Water& water, double time);

  // Simulated so far.
  uint64_t steps() const { return steps_; }

 private:
  bool leadsTo(const Water& water, double steps) const;

  WaveField field_;            // at the end of the last step but one
  double done_ = 0;            // steps up to there
  vec2 size_{0};               // m, of the water
  WaveSimulation simulation_;  // what of it there was until then
  uint64_t steps_ = 0;
};

// Of a scene's objects, by index.
using WaveRuns = std::map<std::size_t, WaveRun>;

}  // namespace nephroid
