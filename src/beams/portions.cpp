#include "beams/portions.h"

#include <algorithm>
#include <cmath>

#include "beams/plane_set.h"
#include "geometry/bounds.h"

namespace nephroid {
namespace {

constexpr std::size_t kMostRays = 4096;  // beams looked at
constexpr double kMostAside = 0.001;     // part of the flux that planes may miss
constexpr float kRoomAside = 0.1f;       // of a cosine: rays of a beam differ
constexpr float kFlatFraction = 1e-4f;   // of a box's longest side: one this thin is a surface

constexpr float kOctantApproach = 0.58f;  // a little more than the cosine for rays along an axis of the world

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

// Unit; zero where the light goes in all directions alike.
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

// The lines of those beams that arrive, for a sample of the beams that represents all of them.
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

// Whether planes across `axis` hold almost all of this flux.
bool goAlong(vec3 axis, std::span<const Line> lines) {
  double all = 0, aside = 0;
  for (const Line& line : lines) {
    all += double(line.flux);
    if (dot(line.direction, axis) < kLeastPlaneApproach) aside += double(line.flux);
  }
  return aside <= kMostAside * all;
}

// From the middle of an octant, a receiver along two axes of the world is never seen edge-on, and no
// direction of the octant is far from the middle.
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
    const bool isAlong = dot(direction, portions[0].axis) >= kLeastPlaneApproach + kRoomAside;
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

}  // namespace nephroid
