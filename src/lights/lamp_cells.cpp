#include "lights/lamp_cells.h"

#include <algorithm>
#include <cmath>

#include "core/directions.h"

namespace nephroid {
namespace {

// Radians that a part of a lamp is seen under, at most, while there are not many.
constexpr float kWidestPart = 0.12f;
constexpr uint32_t kMostPartsAlong = 4;

enum class LampForm { disk, rectangle, segment };

// The lamp's places as offsets along its axes, -1 to 1.
struct LampPlane {
  LampForm form = LampForm::disk;
  vec3 middle{0};  // m, or the direction of light from afar
  vec3 axis[2] = {vec3(0), vec3(0)};
  vec3 toward{0};
  bool isBall = false;
  uvec2 parts{1};
};

vec2 placeOf(LampForm form, vec2 at) {
  if (form == LampForm::disk) return sampleDisk(at);
  return form == LampForm::rectangle ? 2.0f * at - 1.0f : vec2(2 * at.x - 1, 0);
}

// Point `i` of a sequence whose beginnings are spread evenly over the unit square (Roberts 2018).
vec2 spreadPoint(uint32_t i) {
  const glm::dvec2 at = 0.5 + double(i) * glm::dvec2(0.7548776662466927, 0.5698402909980532);
  return vec2(at - floor(at));
}

uint32_t partsFor(float angle) {
  return std::clamp(uint32_t(std::ceil(angle / kWidestPart)), 1u, kMostPartsAlong);
}

LampPlane planeOf(const Light& light, vec3 center, float radius) {
  LampPlane plane;
  plane.middle = middleOf(light);
  const vec3 offset = center - plane.middle;
  const float away = length(offset), nearest = std::max(away - radius, 0.25f * radius);
  const auto partsOf = [&](vec3 half) {
    const vec3 across = away > 0 ? half - dot(half, offset) / (away * away) * offset : half;
    return partsFor(2 * length(across) / std::max(nearest, 1e-30f));
  };
  if (light.type == LightType::line) {
    plane.form = LampForm::segment;
    plane.axis[0] = 0.5f * (light.end - light.position);
    plane.parts.x = partsOf(plane.axis[0]);
    return plane;
  }
  if (light.type == LightType::area) {
    plane.form = LampForm::rectangle;
    plane.axis[0] = 0.5f * light.u;
    plane.axis[1] = 0.5f * light.v;
    plane.parts = {partsOf(plane.axis[0]), partsOf(plane.axis[1])};
    return plane;
  }
  float size = light.radius, angle = 2 * size / std::max(nearest, 1e-30f);
  plane.toward = away > 0 ? offset / away : vec3(0, -1, 0);
  plane.isBall = true;
  if (light.type == LightType::directional) {
    plane.isBall = false;
    plane.middle = plane.toward = light.direction;
    angle = glm::radians(light.angle);
    size = std::sin(0.5f * angle);
  } else if (away < radius + size) {
    angle = 0;  // from within the caster, or near it, it has no one side
  }
  const mat3 frame = frameAround(plane.toward);
  plane.axis[0] = size * frame[0];
  plane.axis[1] = size * frame[1];
  plane.parts = uvec2(partsFor(angle));
  return plane;
}

// The places of part (x, y), offset from their mean, which is returned; and their standard deviations.
vec2 describePart(const LampPlane& plane, uvec2 part, LampSpread& spread) {
  constexpr uint32_t kMany = 4096;
  const auto places = [&](uint32_t count) {
    std::vector<vec2> at;
    for (uint32_t i = 0; i < count; ++i)
      at.push_back(placeOf(plane.form, (vec2(part) + spreadPoint(i)) / vec2(plane.parts)));
    return at;
  };
  const auto meanOf = [](const std::vector<vec2>& at) {
    glm::dvec2 sum(0);
    for (const vec2 place : at) sum += glm::dvec2(place);
    return vec2(sum / double(at.size()));
  };
  const auto deviationOf = [](const std::vector<vec2>& at, vec2 mean) {
    glm::dvec2 sum(0);
    for (const vec2 place : at) sum += glm::dvec2((place - mean) * (place - mean));
    return vec2(sqrt(sum / double(at.size())));
  };
  const std::vector<vec2> all = places(kMany);
  const vec2 middle = meanOf(all);
  spread.deviation = deviationOf(all, middle);
  uint32_t count = 4;
  for (LampPoints& points : spread.points) {
    points.at = places(count);
    const float apart = float(plane.form == LampForm::segment ? count * count : count);
    points.rest = 1 / apart;
    const vec2 mean = meanOf(points.at);
    const vec2 wanted = std::sqrt(1 - points.rest) * spread.deviation;
    const vec2 scale = wanted / max(deviationOf(points.at, mean), vec2(1e-30f));
    for (vec2& at : points.at) at = (at - mean) * scale;
    count *= 4;
  }
  return middle;
}

}  // namespace

std::array<vec3, 2> LampSpread::axesAcross(vec3 direction) const {
  if (!isBall) return {axis[0], axis[1]};
  // The least turn from `toward` to the direction.
  const float cosine = dot(toward, direction);
  const float scale = 1 / std::max(1 + cosine, 1e-3f);
  const vec3 both = toward + direction;
  return {axis[0] - dot(axis[0], direction) * scale * both, axis[1] - dot(axis[1], direction) * scale * both};
}

std::vector<LampCell> lampCells(const Light& light, uint32_t index, vec3 center, float radius) {
  const LampPlane plane = planeOf(light, center, radius);
  const float share = 1 / float(plane.parts.x * plane.parts.y);
  std::vector<LampCell> cells;
  for (uint32_t y = 0; y < plane.parts.y; ++y)
    for (uint32_t x = 0; x < plane.parts.x; ++x) {
      LampCell cell;
      LampSpread& spread = cell.spread;
      spread.axis[0] = plane.axis[0];
      spread.axis[1] = plane.axis[1];
      spread.toward = plane.toward;
      spread.isBall = plane.isBall;
      const vec2 middle = describePart(plane, {x, y}, spread);
      const vec3 offset = middle.x * plane.axis[0] + middle.y * plane.axis[1];
      cell.emitter = lampOf(light, index);
      cell.emitter.power *= share;
      if (light.type == LightType::directional) {
        cell.emitter.direction = normalize(plane.middle + offset);
        cell.emitter.power /= dot(cell.emitter.direction, plane.middle);
      } else {
        cell.emitter.position = plane.middle + offset;
        // A ball looks the same from all over, as wide as its middle is far away.
        const float squared = dot(center - plane.middle, center - plane.middle);
        if (plane.isBall && squared > 0) cell.emitter.power *= 1 + dot(offset, offset) / squared;
      }
      cells.push_back(std::move(cell));
    }
  return cells;
}

}  // namespace nephroid
