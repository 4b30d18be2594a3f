#include "techniques/planes/plan.h"

#include <algorithm>
#include <cmath>

#include "geometry/bounds.h"
#include "techniques/planes/shader_data.h"

namespace nephroid {
namespace {

constexpr std::size_t kMostRays = 4096;     // beams looked at
constexpr double kDepthTail = 0.001;        // part of the flux left before the first and past the last plane
constexpr double kInnerWindowTail = 0.015;  // part of the flux left on each side of the inner window
constexpr float kWindowMargin = 0.02f;      // of a window's side
constexpr double kMostAside = 0.001;        // part of the flux that planes may miss
constexpr float kRoomAside = 0.1f;          // of a cosine: rays of a beam differ
constexpr float kFlatFraction = 1e-4f;      // of a box's longest side: one this thin is a surface

constexpr float kOctantApproach = 0.58f;  // a little more than of rays along an axis of the world

struct Line {
  vec3 origin, direction;
  float flux;
};

Line middleOf(const Beam& beam) {
  return {(beam.position[0] + beam.position[1] + beam.position[2]) / 3.0f,
          normalize(beam.direction[0] + beam.direction[1] + beam.direction[2]),
          beam.flux.x + beam.flux.y + beam.flux.z};
}

// m along the line where it is in the box; false if it never is.
bool meetBox(const ReceiverBox& receiver, const Line& line, float& enters, float& leaves) {
  const Placement& placement = receiver.placement;
  const Box& box = receiver.box;
  const vec3 origin = placement.inversePoint(line.origin);
  const vec3 direction = placement.inverseDirection(line.direction) / placement.scale;
  enters = 0;
  leaves = std::numeric_limits<float>::infinity();
  const vec3 slack = vec3(1e-5f) * (box.size() + 1e-3f);
  for (int i = 0; i < 3; ++i) {
    const float low = box.low[i] - slack[i] - origin[i], high = box.high[i] + slack[i] - origin[i];
    if (direction[i] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const float a = low / direction[i], b = high / direction[i];
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return enters <= leaves;
}

bool isSurface(const ReceiverBox& receiver) {
  const vec3 size = receiver.box.size();
  return std::min({size.x, size.y, size.z}) <= kFlatFraction * receiver.box.longestSide();
}

void addArrivals(const Line& line, std::span<const ReceiverBox> boxes, std::vector<Arrival>& arrivals) {
  float stopped = std::numeric_limits<float>::infinity();
  float enters, leaves;
  for (const ReceiverBox& box : boxes)
    if (isSurface(box) && meetBox(box, line, enters, leaves)) stopped = std::min(stopped, leaves);
  for (const ReceiverBox& box : boxes) {
    if (!meetBox(box, line, enters, leaves) || enters > stopped) continue;
    for (const float distance : {enters, std::min(leaves, stopped)})
      arrivals.push_back({line.origin + distance * line.direction, line.flux});
  }
}

// A place along an axis, m, and the flux that arrives there.
using FluxAt = std::pair<float, float>;

// The place before which `flux` lies.
float placeAfter(std::span<FluxAt> along, double flux) {
  while (along.size() > 1) {
    const std::size_t half = along.size() / 2;
    std::nth_element(along.begin(), along.begin() + std::ptrdiff_t(half), along.end());
    double before = 0;
    for (std::size_t i = 0; i < half; ++i) before += double(along[i].second);
    if (flux <= before) {
      along = along.first(half);
    } else {
      flux -= before;
      along = along.subspan(half);
    }
  }
  return along.front().first;
}

// How far along an axis light arrives, m.
struct Extent {
  float first, low, high, last;  // before `low` and beyond `high` lies a `tail` of the flux each
};

Extent extentAlong(vec3 axis, std::span<const Arrival> arrivals, double tail) {
  std::vector<FluxAt> along;
  along.reserve(arrivals.size());
  double all = 0;
  for (const Arrival& arrival : arrivals) {
    along.emplace_back(dot(arrival.point, axis), arrival.flux);
    all += double(arrival.flux);
  }
  const auto [first, last] = std::ranges::minmax(along);
  return {first.first, placeAfter(along, tail * all), placeAfter(along, (1 - tail) * all), last.first};
}

Window windowAbout(vec2 low, vec2 high, uint32_t texels) {
  const float side = std::max({high.x - low.x, high.y - low.y, 1e-3f}) * (1 + 2 * kWindowMargin);
  return {0.5f * (low + high - side), float(texels) / side, float(texels)};
}

void setAxes(vec3 axis, PlaneSet& set) {
  set.axisW = axis;
  const vec3 aside = std::abs(set.axisW.x) < 0.7f ? vec3(1, 0, 0) : vec3(0, 0, 1);
  set.axisV = normalize(cross(set.axisW, aside));
  set.axisU = cross(set.axisV, set.axisW);
}

// Unit; zero where the light goes all ways alike.
vec3 meanDirection(std::span<const Beam> beams) {
  glm::dvec3 mean(0);
  double flux = 0;
  for (const Beam& beam : beams) {
    const Line middle = middleOf(beam);
    mean += glm::dvec3(middle.direction) * double(middle.flux);
    flux += double(middle.flux);
  }
  return glm::length(mean) > 1e-6 * flux ? vec3(glm::normalize(mean)) : vec3(0);
}

// Lines of beams that arrive, of as many as tell for all.
std::vector<Line> arriving(std::span<const Beam> beams, std::span<const ReceiverBox> boxes) {
  std::vector<Line> lines;
  std::vector<Arrival> arrivals;
  const std::size_t stride = beams.size() / kMostRays + 1;
  for (std::size_t i = 0; i < beams.size(); i += stride) {
    const Line middle = middleOf(beams[i]);
    arrivals.clear();
    addArrivals(middle, boxes, arrivals);
    if (!arrivals.empty()) lines.push_back(middle);
  }
  return lines;
}

// Whether planes across `axis` hold all of these, but for a little.
bool goAlong(vec3 axis, std::span<const Line> lines) {
  double all = 0, aside = 0;
  for (const Line& line : lines) {
    all += double(line.flux);
    if (dot(line.direction, axis) < kLeastApproach) aside += double(line.flux);
  }
  return aside <= kMostAside * all;
}

// No receiver that lies along two axes of the world is seen edge-on from the middle of an octant, and no
// direction in it is far from there.
std::size_t octantOf(vec3 direction) {
  return std::size_t((direction.x < 0 ? 1 : 0) + (direction.y < 0 ? 2 : 0) + (direction.z < 0 ? 4 : 0));
}

vec3 middleOfOctant(std::size_t octant) {
  return normalize(vec3(octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1));
}

}  // namespace

std::vector<LightPortion> portionsByAxis(std::vector<Beam> beams, std::span<const ReceiverBox> boxes) {
  const std::vector<Line> lines = arriving(beams, boxes);
  const vec3 mean = meanDirection(beams);
  std::vector<LightPortion> portions;
  if (goAlong(mean, lines)) {
    portions.push_back({mean, std::move(beams), 0});
    return portions;
  }
  vec3 sum(0);
  for (const Line& line : lines) sum += line.flux * line.direction;
  portions.resize(9);
  portions[0].axis = sum == vec3(0) ? sum : normalize(sum);
  for (std::size_t octant = 0; octant < 8; ++octant)
    portions[1 + octant] = {middleOfOctant(octant), {}, kOctantApproach};
  for (const Beam& beam : beams) {
    const vec3 direction = middleOf(beam).direction;
    const bool isAlong = dot(direction, portions[0].axis) >= kLeastApproach + kRoomAside;
    portions[isAlong ? 0 : 1 + octantOf(direction)].beams.push_back(beam);
  }
  return portions;
}

std::vector<ReceiverBox> receiverBoxes(const Scene& scene) {
  std::vector<ReceiverBox> boxes;
  for (const Object& object : scene.objects) {
    if (scene.isCaster(object)) continue;
    boxes.push_back({object.placement, boundingBox(scene.meshOf(object))});
  }
  return boxes;
}

float nearestAlong(vec3 axis, std::span<const ReceiverBox> boxes) {
  float nearest = std::numeric_limits<float>::infinity();
  for (const ReceiverBox& receiver : boxes)
    for (const vec3& corner : placedCorners(receiver.box, receiver.placement))
      nearest = std::min(nearest, dot(corner, axis));
  return nearest;
}

std::vector<Arrival> findArrivals(std::span<const Beam> beams, std::span<const ReceiverBox> boxes, vec3 axis,
                                  float leastApproach) {
  std::vector<Arrival> arrivals;
  const std::size_t stride = beams.size() / kMostRays + 1;
  for (std::size_t i = 0; i < beams.size(); i += stride) {
    const Line middle = middleOf(beams[i]);
    if (dot(middle.direction, axis) >= leastApproach) addArrivals(middle, boxes, arrivals);
  }
  return arrivals;
}

PlaneSet planPlanes(const PlaneOrder& order, std::span<const Beam> beams, std::span<const Arrival> arrivals) {
  PlaneSet set{};
  if (arrivals.empty()) return set;
  setAxes(order.axis, set);
  const Extent u = extentAlong(set.axisU, arrivals, kInnerWindowTail),
               v = extentAlong(set.axisV, arrivals, kInnerWindowTail),
               w = extentAlong(set.axisW, arrivals, kDepthTail);
  set.windows[0] = windowAbout({u.low, v.low}, {u.high, v.high}, order.textureSize);
  set.windows[1] = windowAbout({u.first, v.first}, {u.last, v.last}, order.textureSize / 2);
  const bool isOne = order.planes == 1 || w.high - w.low < 1e-4f / set.windows[0].texelsPerMetre;
  set.planes = isOne ? 1 : order.planes;
  set.firstDepth = isOne ? 0.5f * (w.low + w.high) : w.low;
  set.depthStep = isOne ? 0 : (w.high - w.low) / float(order.planes - 1);
  set.nearestDepth = order.nearestDepth;
  set.farthestDepth = w.last + 0.01f * (w.last - set.nearestDepth) + 1e-3f;
  vec3 flux(0);
  for (const Beam& beam : beams) flux += beam.flux;
  set.luxMetresSquaredPerUnit = max(flux, vec3(1e-20f)) / kUnitsOfAllFlux;
  return set;
}

PlaneSet planAlongLight(const LightPortion& portion, std::span<const ReceiverBox> boxes, uint32_t planes,
                        uint32_t textureSize) {
  const vec3 axis = portion.axis;
  const std::vector<Beam>& beams = portion.beams;
  if (axis == vec3(0)) return {};
  float nearest = std::numeric_limits<float>::infinity();
  for (const Beam& beam : beams)
    for (const vec3 position : beam.position) nearest = std::min(nearest, dot(position, axis));
  return planPlanes({axis, nearest, planes, textureSize}, beams,
                    findArrivals(beams, boxes, axis, kLeastApproach));
}

}  // namespace nephroid
