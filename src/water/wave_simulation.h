// Solves the wave equation u_tt + damping u_t = c^2 (u_xx + u_zz) on a grid, with central differences in time
// and space. The sides reflect waves (the slope across them is 0).
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

// The longest stable time step (s); with longer steps waves grow without limit. `spacing`: m; `speed`: m/s.
double stableStep(glm::dvec2 spacing, double speed);

void advance(WaveField& field);

// Kinetic and potential energy, in J per kg/m2 of moving water. Without damping, `advance` does not change
// it.
double energy(const WaveField& field);

// The number of steps of the simulation up to `time` (s).
double simulationSteps(const Water& water, double time);

// Heights (m) at the vertices of the water's grid, [j * grid.x + i] with i along x. The water is still before
// time 0.
std::vector<double> simulatedHeights(const Water& water, double time);

// A simulation that is evaluated at one time after another and keeps its last state.
class WaveRun {
 public:
  // The same heights as simulatedHeights, bit for bit. Continues from the last time, unless that is later
  // than `time`, or the water was changed in a way that matters before the last time.
  std::vector<double> heightsAt(const Water& water, double time);

  // The number of steps simulated so far.
  uint64_t steps() const { return steps_; }

 private:
  bool leadsTo(const Water& water, double steps) const;

  WaveField field_;            // after the second last step
  double done_ = 0;            // steps up to there
  vec2 size_{0};               // m, of the water
  WaveSimulation simulation_;  // the part of the simulation that took effect until then
  uint64_t steps_ = 0;
};

// The runs of a scene's objects, by the index of the object.
using WaveRuns = std::map<std::size_t, WaveRun>;

}  // namespace nephroid
