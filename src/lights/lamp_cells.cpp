#include "lights/lamp_cells.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/directions.h"
#include "core/hash.h"
#include "lights/sky.h"

namespace nephroid {
namespace {

// Radians that a part of a lamp is seen under, and parts along an axis, for an error of 1 %: what is off
// grows as the square of the angle.
constexpr float kWidestPart = 0.3f, kMostPartsAlong = 2;
constexpr float kErrorOfWidest = 0.01f;
// The same of a sky (skyParts): some 256 parts of an even one.
constexpr float kSpreadOfSkyParts = 0.008f;
constexpr double kFlat = 1e-12;  // variance of what has no extent

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

// Point `i` of `count`, a power of two, spread evenly over the unit square, also along each of its sides
// (Hammersley 1960).
vec2 spreadPoint(uint32_t i, uint32_t count) {
  float mirrored = 0;
  for (uint32_t bit = count / 2; bit > 0; bit /= 2) mirrored = 0.5f * (mirrored + float(i / bit % 2));
  return {(float(i) + 0.5f) / float(count), mirrored + 0.5f / float(count)};
}

// Moves places so that their mean is 0 and their covariance that of the unit square's, 1 along each axis.
void evenOut(std::span<vec2> places) {
  const double count = double(places.size());
  glm::dvec2 mean(0);
  for (const vec2 place : places) mean += glm::dvec2(place) / count;
  double xx = 0, xy = 0, yy = 0;
  for (const vec2 place : places) {
    const glm::dvec2 off = glm::dvec2(place) - mean;
    xx += off.x * off.x / count;
    xy += off.x * off.y / count;
    yy += off.y * off.y / count;
  }
  const double slope = xx > 0 ? xy / xx : 0, rest = yy - slope * xy;
  for (vec2& place : places) {
    const glm::dvec2 off = glm::dvec2(place) - mean;
    place = vec2(xx > 0 ? off.x / std::sqrt(xx) : 0,
                 rest > kFlat ? (off.y - slope * off.x) / std::sqrt(rest) : 0);
  }
}

uint32_t partsFor(float angle, float error) {
  const float finer = std::sqrt(kErrorOfWidest / error);
  return uint32_t(
      std::clamp(std::ceil(angle * finer / kWidestPart), 1.0f, std::ceil(kMostPartsAlong * finer)));
}

LampPlane planeOf(const Light& light, vec3 center, float radius, float error) {
  LampPlane plane;
  plane.middle = middleOf(light);
  const vec3 offset = center - plane.middle;
  const float away = length(offset), nearest = std::max(away - radius, 0.25f * radius);
  // Light that comes from nearer by moves farther: places that are not equally far away need more parts.
  constexpr float kWeightOfDepth = 4;
  const auto partsOf = [&](vec3 half) {
    const vec3 axis = away > 0 ? offset / away : vec3(0);
    const float deep = std::abs(dot(half, axis)), wide = length(half - dot(half, axis) * axis);
    return partsFor(2 * (wide + kWeightOfDepth * deep) / std::max(nearest, 1e-30f), error);
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
  plane.parts = uvec2(partsFor(angle, error));
  return plane;
}

// The mean of the places of part (x, y), and what they are about it.
vec2 describePart(const LampPlane& plane, uvec2 part, LampSpread& spread) {
  constexpr uint32_t kAll = 4096;
  const auto place = [&](uint32_t i, uint32_t count) {
    return placeOf(plane.form, (vec2(part) + spreadPoint(i, count)) / vec2(plane.parts));
  };
  glm::dvec2 sum(0), squares(0);
  for (uint32_t i = 0; i < kAll; ++i) {
    const glm::dvec2 at(place(i, kAll));
    sum += at / double(kAll);
    squares += at * at / double(kAll);
  }
  spread.isLine = plane.form == LampForm::segment;
  spread.deviation = vec2(sqrt(max(squares - sum * sum, glm::dvec2(0))));
  for (uint32_t i = 0; i < kFewLampPlaces; ++i) spread.fewPlaces[i] = place(i, kFewLampPlaces);
  for (uint32_t i = 0; i < kLampPlaces; ++i) spread.places[i] = place(i, kLampPlaces);
  for (uint32_t i = 0; i < kManyLampPlaces; ++i) spread.manyPlaces[i] = place(i, kManyLampPlaces);
  evenOut(spread.fewPlaces);
  evenOut(spread.places);
  evenOut(spread.manyPlaces);
  return vec2(sum);
}

// What a part's places send to `center` in the mean, over what its middle does.
float meanOverMiddle(const LampCell& cell, vec3 center) {
  const LampSpread& spread = cell.spread;
  const auto sent = [&](vec3 position) {
    Emitter emitter = cell.emitter;
    emitter.power = vec3(1);
    emitter.position = position;
    return emitterIlluminance(emitter, center).x;
  };
  const float middle = sent(cell.emitter.position);
  if (!(middle > 0)) return 1;
  float sum = 0;
  for (const vec2 place : spread.places) {
    const vec2 at = place * spread.deviation;
    sum += sent(cell.emitter.position + at.x * spread.axis[0] + at.y * spread.axis[1]);
  }
  return sum / (middle * float(kLampPlaces));
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

std::vector<LampCell> lampCells(const Light& light, uint32_t index, vec3 center, float radius, float error) {
  const LampPlane plane = planeOf(light, center, radius, error);
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
      spread.isOneOfMore = share < 1;
      const vec2 middle = describePart(plane, {x, y}, spread);
      const vec3 offset = middle.x * plane.axis[0] + middle.y * plane.axis[1];
      cell.emitter = lampOf(light, index);
      cell.emitter.power *= share;
      if (light.type == LightType::directional) {
        cell.emitter.direction = normalize(plane.middle + offset);
        cell.emitter.power /= dot(cell.emitter.direction, plane.middle);
      } else {
        cell.emitter.position = plane.middle + offset;
        // A surface that faces a ball gets from its parts, at a slant, what the middle would send.
        const float squared = dot(center - plane.middle, center - plane.middle);
        if (!plane.isBall)
          cell.emitter.power *= meanOverMiddle(cell, center);
        else if (squared > 0)
          cell.emitter.power *= std::pow(1 + dot(offset, offset) / squared, 1.5f);
      }
      cells.push_back(std::move(cell));
    }
  return cells;
}

std::vector<LampCell> skyCells(const Light& light, uint32_t index, std::span<const SkyPart> parts) {
  LampCell cell;
  describePart({.form = LampForm::disk}, {0, 0}, cell.spread);
  cell.spread.isOneOfMore = true;
  const mat3 turned = skyTurned(light.skyRotation);
  std::vector<LampCell> cells;
  for (const SkyPart& part : parts) {
    cell.emitter = emitterOf(light, index, part);
    for (int axis = 0; axis < 2; ++axis) {
      const vec3 spread = turned * part.spread[axis];
      cell.spread.deviation[axis] = length(spread);
      cell.spread.axis[axis] = spread / std::max(length(spread), 1e-30f);
    }
    cells.push_back(cell);
  }
  return cells;
}

std::span<const SkyPart> CutSkies::partsOf(const SkyMap& map, float error, uint32_t most) {
  constexpr std::size_t kMostKept = 8;
  const uint64_t hash = hashBytes(std::as_bytes(std::span(map.luminance)));
  auto found = std::ranges::find_if(cuts_, [&](const Cut& cut) {
    return cut.map == hash && cut.size == map.size && cut.error == error && cut.most == most;
  });
  if (found == cuts_.end()) {
    if (cuts_.size() == kMostKept) cuts_.pop_back();
    const double spread = double(kSpreadOfSkyParts * error / kErrorOfWidest);
    cuts_.push_back({hash, map.size, error, most, skyParts(map, most, spread)});
    found = cuts_.end() - 1;
  }
  std::rotate(cuts_.begin(), found, found + 1);
  return cuts_.front().parts;
}

}  // namespace nephroid
