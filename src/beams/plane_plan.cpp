#include "beams/plane_plan.h"

#include <algorithm>
#include <cmath>

namespace nephroid {
namespace {

constexpr double kDepthTail = 0.001;        // part of the flux left before the first and past the last plane
constexpr double kInnerWindowTail = 0.015;  // part of the flux left on each side of the inner window
constexpr float kWindowMargin = 0.02f;      // of a window's side

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

}  // namespace

PlaneSet planPlanes(const PlaneOrder& order, std::span<const Beam> beams, std::span<const Arrival> arrivals) {
  PlaneSet set{};
  if (arrivals.empty()) return set;
  setAxes(order.axis, set);
  const Extent u = extentAlong(set.axisU, arrivals, kInnerWindowTail),
               v = extentAlong(set.axisV, arrivals, kInnerWindowTail),
               w = extentAlong(set.axisW, arrivals, kDepthTail);
  set.windows[0] = windowAbout({u.low, v.low}, {u.high, v.high}, order.textureSize);
  set.windows[1] = windowAbout({u.first, v.first}, {u.last, v.last}, order.textureSize / 2);
  const bool isOne = order.planes == 1 || w.high - w.low < 1e-4f / set.windows[0].texelsPerMeter;
  set.planes = isOne ? 1 : order.planes;
  set.firstDepth = isOne ? 0.5f * (w.low + w.high) : w.low;
  set.depthStep = isOne ? 0 : (w.high - w.low) / float(order.planes - 1);
  set.nearestDepth = order.nearestDepth;
  set.farthestDepth = w.last + 0.01f * (w.last - set.nearestDepth) + 1e-3f;
  vec3 flux(0);
  for (const Beam& beam : beams) flux += beam.flux;
  set.luxMetersSquaredPerUnit = max(flux, vec3(1e-20f)) / kUnitsOfAllFlux;
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
                    findArrivals(beams, boxes, axis, kLeastPlaneApproach));
}

}  // namespace nephroid
