#include "water/wave_simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nephroid {
namespace {

using glm::dvec2;

// Of the longest that is stable, so that short waves are not too slow.
constexpr double kPartOfStableStep = 0.5;

WaveField stillField(const Water& water) {
  WaveField field;
  field.grid = water.grid;
  field.spacing = dvec2(water.size) / dvec2(water.grid - 1u);
  field.speed = double(water.simulation->speed);
  field.damping = double(water.simulation->damping);
  field.step = kPartOfStableStep * stableStep(field.spacing, field.speed);
  field.heights.assign(std::size_t{water.grid.x} * water.grid.y, 0);
  field.before = field.heights;
  return field;
}

// Adds to the water, in motion as it is, profile(squared distance from `center` over the squared radius).
template <class Profile>
void raise(WaveField& field, dvec2 center, double radius, const Profile& profile) {
  constexpr double kReach = 4;  // radii
  const dvec2 half = 0.5 * field.spacing * dvec2(field.grid - 1u);
  const dvec2 first = (center + half - kReach * radius) / field.spacing,
              last = (center + half + kReach * radius) / field.spacing;
  const auto within = [](double place, uint32_t count) {
    return uint32_t(std::clamp(place, 0.0, double(count)));
  };
  for (uint32_t z = within(std::ceil(first.y), field.grid.y); z < within(last.y + 1, field.grid.y); ++z)
    for (uint32_t x = within(std::ceil(first.x), field.grid.x); x < within(last.x + 1, field.grid.x); ++x) {
      const dvec2 offset = (dvec2(x, z) * field.spacing - half - center) / radius;
      const double height = profile(glm::dot(offset, offset));
      const std::size_t at = std::size_t{z} * field.grid.x + x;
      field.heights[at] += height;
      field.before[at] += height;
    }
}

dvec2 placeOf(const WaterObstacle& obstacle, double time) {
  const std::vector<vec3>& path = obstacle.path;
  const auto next = std::ranges::find_if(path, [&](const vec3& at) { return double(at.z) > time; });
  if (next == path.begin()) return dvec2(path.front());
  if (next == path.end()) return dvec2(path.back());
  const vec3 &from = *(next - 1), &to = *next;
  return glm::mix(dvec2(from), dvec2(to), (time - double(from.z)) / double(to.z - from.z));
}

// The water that an obstacle drives out rises where it comes, and falls where it leaves.
void move(WaveField& field, const WaterObstacle& obstacle, double from, double to) {
  const dvec2 was = placeOf(obstacle, from), is = placeOf(obstacle, to);
  if (was == is) return;
  const auto body = [&](double squared) { return double(obstacle.depth) * std::exp(-squared); };
  raise(field, was, double(obstacle.radius), [&](double squared) { return -body(squared); });
  raise(field, is, double(obstacle.radius), body);
}

// From time step * `number` to the next.
void simulateStep(WaveField& field, const WaveSimulation& simulation, double number) {
  const double from = number * field.step, to = (number + 1) * field.step;
  for (const WaterDrop& drop : simulation.drops)
    if (double(drop.time) >= from && double(drop.time) < to)
      raise(field, dvec2(drop.position), double(drop.radius),
            [&](double squared) { return -double(drop.depth) * (1 - squared) * std::exp(-squared); });
  for (const WaterObstacle& obstacle : simulation.obstacles) move(field, obstacle, from, to);
  advance(field);
}

// Before it, the water is still.
double firstMotion(const WaveSimulation& simulation) {
  double first = std::numeric_limits<double>::infinity();
  for (const WaterDrop& drop : simulation.drops) first = std::min(first, double(drop.time));
  for (const WaterObstacle& obstacle : simulation.obstacles)
    first = std::min(first, double(obstacle.path.front().z));
  return first;
}

// What there is of a simulation until `time` (s), as far as the water can tell.
WaveSimulation before(const WaveSimulation& simulation, double time) {
  WaveSimulation part = simulation;
  std::erase_if(part.drops, [&](const WaterDrop& drop) { return double(drop.time) >= time; });
  for (WaterObstacle& obstacle : part.obstacles) {
    const auto next =
        std::ranges::find_if(obstacle.path, [&](const vec3& at) { return double(at.z) >= time; });
    // It is on its way there.
    if (next != obstacle.path.end()) obstacle.path.erase(next + 1, obstacle.path.end());
  }
  std::erase_if(part.obstacles,
                [&](const WaterObstacle& obstacle) { return double(obstacle.path.front().z) >= time; });
  return part;
}

}  // namespace

double stableStep(dvec2 spacing, double speed) {
  return 1 / (speed * std::sqrt(1 / (spacing.x * spacing.x) + 1 / (spacing.y * spacing.y)));
}

void advance(WaveField& field) {
  const dvec2 courant = field.speed * field.step / field.spacing;
  const dvec2 weights = courant * courant;
  const double half = 0.5 * field.damping * field.step;
  const std::size_t width = field.grid.x;
  const std::vector<double>& now = field.heights;
  for (std::size_t z = 0; z < field.grid.y; ++z) {
    // Beyond a side the water is as before it.
    const std::size_t up = z > 0 ? z - 1 : 1, down = z + 1 < field.grid.y ? z + 1 : z - 1;
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t left = x > 0 ? x - 1 : 1, right = x + 1 < width ? x + 1 : x - 1;
      const double here = now[z * width + x];
      const double pull = weights.x * (now[z * width + left] + now[z * width + right] - 2 * here) +
                          weights.y * (now[up * width + x] + now[down * width + x] - 2 * here);
      double& next = field.before[z * width + x];
      next = (2 * here - (1 - half) * next + pull) / (1 + half);
    }
  }
  std::swap(field.heights, field.before);
}

double energy(const WaveField& field) {
  const std::size_t width = field.grid.x;
  const double cell = field.spacing.x * field.spacing.y;
  const std::vector<double>&now = field.heights, &before = field.before;
  const auto share = [](std::size_t place, std::size_t count) {
    return place == 0 || place + 1 == count ? 0.5
                                            : 1.0;  // of the cell about a vertex, what is within the sides
  };
  double sum = 0;
  for (std::size_t z = 0; z < field.grid.y; ++z)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t at = z * width + x;
      const double rate = (now[at] - before[at]) / field.step;
      const double shareX = share(x, width), shareZ = share(z, field.grid.y);
      sum += shareX * shareZ * rate * rate;
      const auto tension = [&](std::size_t next, double spacing) {
        return field.speed * field.speed * (now[next] - now[at]) * (before[next] - before[at]) /
               (spacing * spacing);
      };
      if (x + 1 < width) sum += shareZ * tension(at + 1, field.spacing.x);
      if (z + 1 < field.grid.y) sum += shareX * tension(at + width, field.spacing.y);
    }
  return 0.5 * cell * sum;
}

double simulationSteps(const Water& water, double time) {
  return std::max(time, 0.0) / stillField(water).step;
}

std::vector<double> simulatedHeights(const Water& water, double time) {
  return WaveRun().heightsAt(water, time);
}

bool WaveRun::leadsTo(const Water& water, double steps) const {
  return steps_ > 0 && done_ <= steps && field_.grid == water.grid && size_ == water.size &&
         simulation_ == before(*water.simulation, done_ * field_.step);
}

std::vector<double> WaveRun::heightsAt(const Water& water, double time) {
  const double steps = simulationSteps(water, time);
  if (!leadsTo(water, steps)) {
    field_ = stillField(water);
    // A step early: what is rounded up may not pass it by.
    done_ = std::floor(std::clamp(firstMotion(*water.simulation) / field_.step - 1, 0.0, steps));
    size_ = water.size;
  }
  const auto step = [&](WaveField& field) {
    simulateStep(field, *water.simulation, done_);
    ++steps_;
  };
  for (; done_ + 1 < steps; ++done_) step(field_);
  simulation_ = before(*water.simulation, done_ * field_.step);
  WaveField last = field_;
  if (!(done_ < steps)) return std::move(last.heights);
  step(last);
  // Between the last two steps.
  const double part = done_ + 1 - steps;
  for (std::size_t i = 0; i < last.heights.size(); ++i)
    last.heights[i] += part * (last.before[i] - last.heights[i]);
  return std::move(last.heights);
}

}  // namespace nephroid
