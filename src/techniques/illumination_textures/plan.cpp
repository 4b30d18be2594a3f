#include "techniques/illumination_textures/plan.h"

#include <algorithm>
#include <cmath>

#include "techniques/illumination_textures/shader_data.h"

namespace nephroid {
namespace {

constexpr std::size_t kMostRays = 4096;     // beams looked at
constexpr double kDepthTail = 0.001;        // part of the flux left before the first and past the last plane
constexpr double kInnerWindowTail = 0.015;  // part of the flux left on each side of the inner window
constexpr float kWindowMargin = 0.02f;      // of a window's side
constexpr float kFlatFraction = 1e-4f;      // of a box's longest side: one this thin is a surface

// Where a beam arrives: place along the planes and depth, with the flux that arrives there.
struct Arrival {
  vec2 place;
  float depth;
  float flux;
};

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
bool meetBox(const ReceiverBox& box, const Line& line, float& enters, float& leaves) {
  const vec3 origin = box.placement.inversePoint(line.origin);
  const vec3 direction = box.placement.inverseDirection(line.direction) / box.placement.scale;
  enters = 0;
  leaves = std::numeric_limits<float>::infinity();
  const vec3 slack = vec3(1e-5f) * (box.high - box.low + 1e-3f);
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

bool isSurface(const ReceiverBox& box) {
  const vec3 size = box.high - box.low;
  return std::min({size.x, size.y, size.z}) <= kFlatFraction * std::max({size.x, size.y, size.z});
}

void addArrivals(const Line& line, std::span<const ReceiverBox> boxes, const PlaneSet& set,
                 std::vector<Arrival>& arrivals) {
  float stopped = std::numeric_limits<float>::infinity();
  float enters, leaves;
  for (const ReceiverBox& box : boxes)
    if (isSurface(box) && meetBox(box, line, enters, leaves)) stopped = std::min(stopped, leaves);
  for (const ReceiverBox& box : boxes) {
    if (!meetBox(box, line, enters, leaves) || enters > stopped) continue;
    for (const float distance : {enters, std::min(leaves, stopped)}) {
      const vec3 point = line.origin + distance * line.direction;
      arrivals.push_back({{dot(point, set.axisU), dot(point, set.axisV)}, dot(point, set.axisW), line.flux});
    }
  }
}

// The values at which `tail` and 1 - `tail` of the flux lie below.
template <class Value>
vec2 fluxRange(std::vector<Arrival>& arrivals, double tail, const Value& value) {
  std::sort(arrivals.begin(), arrivals.end(),
            [&](const Arrival& a, const Arrival& b) { return value(a) < value(b); });
  double all = 0;
  for (const Arrival& arrival : arrivals) all += arrival.flux;
  vec2 range(value(arrivals.front()), value(arrivals.back()));
  double below = 0;
  bool hasLow = false;
  for (const Arrival& arrival : arrivals) {
    below += arrival.flux;
    if (!hasLow && below >= tail * all) {
      range.x = value(arrival);
      hasLow = true;
    }
    if (below >= (1 - tail) * all) {
      range.y = value(arrival);
      break;
    }
  }
  return range;
}

Window windowAbout(std::vector<Arrival>& arrivals, double tail, uint32_t textureSize) {
  const vec2 u = fluxRange(arrivals, tail, [](const Arrival& a) { return a.place.x; });
  const vec2 v = fluxRange(arrivals, tail, [](const Arrival& a) { return a.place.y; });
  const float side = std::max({u.y - u.x, v.y - v.x, 1e-3f}) * (1 + 2 * kWindowMargin);
  return {vec2(0.5f * (u.x + u.y - side), 0.5f * (v.x + v.y - side)), float(textureSize) / side,
          float(textureSize)};
}

void setAxes(vec3 meanDirection, PlaneSet& set) {
  set.axisW = normalize(meanDirection);
  const vec3 aside = std::abs(set.axisW.x) < 0.7f ? vec3(1, 0, 0) : vec3(0, 0, 1);
  set.axisV = normalize(cross(set.axisW, aside));
  set.axisU = cross(set.axisV, set.axisW);
}

}  // namespace

std::vector<ReceiverBox> receiverBoxes(const Scene& scene) {
  std::vector<ReceiverBox> boxes;
  for (const Object& object : scene.objects) {
    if (scene.isCaster(object)) continue;
    const std::vector<vec3>& positions = scene.meshOf(object).positions;
    ReceiverBox box{object.placement, positions[0], positions[0]};
    for (const vec3& p : positions) {
      box.low = min(box.low, p);
      box.high = max(box.high, p);
    }
    boxes.push_back(box);
  }
  return boxes;
}

PlaneSet planPlanes(std::span<const Beam> beams, std::span<const ReceiverBox> boxes, uint32_t planes,
                    uint32_t textureSize) {
  PlaneSet set{};
  glm::dvec3 mean(0), flux(0);
  for (const Beam& beam : beams) {
    const Line middle = middleOf(beam);
    mean += glm::dvec3(middle.direction) * double(middle.flux);
    flux += glm::dvec3(beam.flux);
  }
  if (glm::length(mean) <= 1e-6 * (flux.x + flux.y + flux.z)) return set;
  setAxes(vec3(glm::normalize(mean)), set);

  std::vector<Arrival> arrivals;
  const std::size_t stride = beams.size() / kMostRays + 1;
  set.nearestDepth = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < beams.size(); i += stride) {
    const Line middle = middleOf(beams[i]);
    if (dot(middle.direction, set.axisW) < kLeastApproach) continue;
    set.nearestDepth = std::min(set.nearestDepth, dot(middle.origin, set.axisW));
    addArrivals(middle, boxes, set, arrivals);
  }
  if (arrivals.empty()) return set;

  set.windows[0] = windowAbout(arrivals, kInnerWindowTail, textureSize);
  set.windows[1] = windowAbout(arrivals, 0, textureSize / 2);
  const vec2 depths = fluxRange(arrivals, kDepthTail, [](const Arrival& a) { return a.depth; });
  const bool isOne = planes == 1 || depths.y - depths.x < 1e-4f / set.windows[0].texelsPerMetre;
  set.planes = isOne ? 1 : planes;
  set.firstDepth = isOne ? 0.5f * (depths.x + depths.y) : depths.x;
  set.depthStep = isOne ? 0 : (depths.y - depths.x) / float(planes - 1);
  // After the last sort the arrivals are in the order of their depths.
  set.farthestDepth = arrivals.back().depth + 0.01f * (arrivals.back().depth - set.nearestDepth) + 1e-3f;
  set.luxMetresSquaredPerUnit = max(vec3(flux), vec3(1e-20f)) / kUnitsOfAllFlux;
  return set;
}

}  // namespace nephroid
