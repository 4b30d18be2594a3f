#include "beams/tree.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/box.h"
#include "transport/outgoing_ray.h"

namespace nephroid {
namespace {

constexpr float kFar = 1e30f;
// Rays that go along their way less than this part of their length have no slope worth having.
constexpr float kLeastAlong = 0.05f;

BeamBounds emptyBounds() {
  return {vec2(kFar), vec2(-kFar), vec2(kFar), vec2(-kFar), 0, kFar, -kFar, 0, 0, {}};
}

// Bits of the low half of a word, every other one.
uint64_t spread(uint64_t bits) {
  bits = (bits | (bits << 16)) & 0x0000ffff0000ffffull;
  bits = (bits | (bits << 8)) & 0x00ff00ff00ff00ffull;
  bits = (bits | (bits << 4)) & 0x0f0f0f0f0f0f0f0full;
  bits = (bits | (bits << 2)) & 0x3333333333333333ull;
  return (bits | (bits << 1)) & 0x5555555555555555ull;
}

// Where a beam stands in the order: by its way, then along a curve that fills the plane across it (Morton
// 1966).
struct Place {
  uint64_t key = 0;
  uint32_t portion = 0;
  uint32_t beam = 0;

  bool operator<(const Place& other) const {
    if (key != other.key) return key < other.key;
    return portion != other.portion ? portion < other.portion : beam < other.beam;
  }
};

vec3 startOf(const Beam& beam) {
  return (beam.position[0] + beam.position[1] + beam.position[2]) / 3.0f;
}

std::vector<Place> placesOf(std::span<const std::vector<Beam>> portions) {
  std::vector<Place> places;
  std::array<vec2, kWays> lows, highs;
  lows.fill(vec2(kFar));
  highs.fill(vec2(-kFar));
  for (uint32_t portion = 0; portion < portions.size(); ++portion)
    for (uint32_t i = 0; i < portions[portion].size(); ++i) {
      const Beam& beam = portions[portion][i];
      const uint32_t way = wayOf(beam);
      const vec2 start(inWay(startOf(beam), way));
      lows[way] = min(lows[way], start);
      highs[way] = max(highs[way], start);
      places.push_back({way, portion, i});
    }
  oneapi::tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
    Place& place = places[i];
    const auto way = uint32_t(place.key);
    const vec2 start(inWay(startOf(portions[place.portion][place.beam]), way));
    const vec2 size = highs[way] - lows[way];
    const vec2 part = clamp((start - lows[way]) / std::max({size.x, size.y, 1e-20f}), vec2(0), vec2(1));
    const auto bits = [](float value) { return spread(uint64_t(value * float((1u << 24) - 1))); };
    place.key = (uint64_t{way} << 56) | (bits(part.x) << 1) | bits(part.y);
  });
  oneapi::tbb::parallel_sort(places.begin(), places.end());
  return places;
}

// m along the way, before which no ray begins: between points of rays on both sides of the reference plane
// there would be some that neither the crossings nor the slopes bound.
float leastStart(std::span<const Beam> beams, uint32_t way) {
  float least = kFar;
  for (const Beam& beam : beams)
    for (const vec3& position : beam.position) least = std::min(least, inWay(position, way).z);
  return least;
}

void include(BeamBounds& bounds, const Beam& beam, uint32_t way) {
  Box ends;  // where light does
  float longest = 0;
  for (int i = 0; i < 3; ++i) {
    const vec3 start = inWay(beam.position[i], way), direction = inWay(beam.direction[i], way);
    if (direction.z < kLeastAlong) bounds.kind = kEveryWay;
    const vec2 slope = vec2(direction) / std::max(direction.z, kLeastAlong);
    const vec2 crossing = vec2(start) + slope * (bounds.reference - start.z);
    const vec2 rounding = 1e-6f * (abs(vec2(start)) + abs(crossing));
    bounds.crossingLow = min(bounds.crossingLow, crossing - rounding);
    bounds.crossingHigh = max(bounds.crossingHigh, crossing + rounding);
    bounds.slopeLow = min(bounds.slopeLow, slope);
    bounds.slopeHigh = max(bounds.slopeHigh, slope);
    bounds.nearest = std::min(bounds.nearest, start.z);
    longest = std::max(longest, beam.reach[i]);
    ends.include(start + beam.reach[i] * direction);
  }
  const bool isBounded = longest < kUnboundedReach;
  const float tolerance = reachTolerance(longest, isBounded ? ends.diagonal() : 0);
  bounds.farthest = isBounded ? std::max(bounds.farthest, ends.high.z + tolerance) : kFar;
  if (isBounded) bounds.nearest -= tolerance;
}

}  // namespace

uint32_t wayOf(const Beam& beam) {
  const vec3 direction = beam.direction[0] + beam.direction[1] + beam.direction[2];
  const vec3 size = abs(direction);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return 2 * uint32_t(axis) + (direction[axis] < 0 ? 1 : 0);
}

BeamBounds boundsOf(std::span<const Beam> beams, uint32_t way) {
  BeamBounds bounds = emptyBounds();
  bounds.kind = way;
  bounds.reference = leastStart(beams, way);
  for (const Beam& beam : beams) include(bounds, beam, way);
  return bounds;
}

BeamTree buildBeamTree(std::span<const std::vector<Beam>> portions) {
  BeamTree tree;
  const std::vector<Place> places = placesOf(portions);
  const std::size_t count = places.size();
  tree.beams.resize(count);
  tree.bounds.assign(std::max<std::size_t>(1, (count + kChildren - 1) / kChildren) * kChildren,
                     emptyBounds());
  oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const Beam& beam = portions[places[i].portion][places[i].beam];
    tree.beams[i] = beam;
    tree.bounds[i] = boundsOf({&beam, 1}, wayOf(beam));
    tree.bounds[i].first = uint32_t(i);
    tree.bounds[i].kind |= kIsBeam | (places[i].portion << kPortionShift);
  });
  std::size_t begin = 0, end = tree.bounds.size(), beamsInEach = 1;
  while (end - begin > kChildren) {
    const std::size_t parents = (end - begin) / kChildren;
    beamsInEach *= kChildren;
    tree.bounds.resize(end + (parents + kChildren - 1) / kChildren * kChildren, emptyBounds());
    oneapi::tbb::parallel_for(std::size_t{0}, parents, [&](std::size_t parent) {
      const std::size_t first = parent * beamsInEach;
      if (first >= count) return;
      const auto own = std::span(tree.beams).subspan(first, std::min(beamsInEach, count - first));
      const uint32_t way = wayOf(own.front());
      BeamBounds& bounds = tree.bounds[end + parent];
      bounds = boundsOf(own, way);
      if (wayOf(own.back()) != way) bounds.kind = kEveryWay;
      bounds.first = uint32_t(begin + parent * kChildren);
    });
    begin = end;
    end = tree.bounds.size();
  }
  tree.root = uint32_t(begin);
  return tree;
}

}  // namespace nephroid
