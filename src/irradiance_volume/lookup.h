// Looks up the caustic light stored around a caster. Written once for C++ and GLSL.
//
// A shader defines `struct VolumeView` with `uvec3 size` and `uint volumeWord(VolumeView volume, uint
// index)`, `struct FlowView` with `vec3 origin`, `vec3 scale` and `uint side`, and `vec3 flowMove(FlowView
// flow, uvec3 node)`, includes this, and defines `gridLight` by images, which it filters faster.
#ifndef NEPHROID_IRRADIANCE_VOLUME_LOOKUP_H
#define NEPHROID_IRRADIANCE_VOLUME_LOOKUP_H

#include "core/octahedral.h"
#include "core/shared_language.h"

#ifdef __cplusplus
#include <glm/gtc/packing.hpp>
namespace nephroid {
struct VolumeView {
  uvec3 size;
  const uint* words;
};
inline uint volumeWord(const VolumeView& volume, uint index) {
  return volume.words[index];
}
struct FlowView {
  vec3 origin;
  vec3 scale;
  uint side;
  const vec3* moves;
};
inline vec3 flowMove(const FlowView& flow, uvec3 node) {
  return flow.moves[(node.z * flow.side + node.y) * flow.side + node.x];
}
using glm::uintBitsToFloat;
using glm::unpackHalf2x16;
}  // namespace nephroid
#endif

SHARED_BEGIN

SHARED_CONSTANT uint kRepresentationGrid = 0u;
SHARED_CONSTANT uint kRepresentationShells = 1u;
SHARED_CONSTANT uint kRepresentationMultiResolution = 2u;
SHARED_CONSTANT uint kRepresentationHarmonics = 3u;  // resolved into a grid before it is looked up

SHARED_CONSTANT uint kWordsOfCell = 2u;
// The words before the cells of shells. The first tells how far around the light's direction the shells
// reach, as a part of the octahedral map's side. The others tell for kShellRadii + 1 radii which shell,
// counted from the center, is there.
SHARED_CONSTANT uint kShellRadii = 64u;
SHARED_CONSTANT uint kShellWords = kShellRadii + 2u;
// Shells hold light multiplied by the square of the distance from the center (in radii of the region; at
// least this value). Light that spreads from the center then changes little from shell to shell.
SHARED_CONSTANT float kLeastShellSquare = 1e-3f;

// The number of finest intervals along a brick's side in a multi-resolution volume.
SHARED_CONSTANT uint kBrickIntervals = 8u;
SHARED_CONSTANT uint kDarkBrick = 0xffffffffu;

// The light at a place. A surface with the unit normal n, which is lit from its front only, has the
// illuminance -dot(n, vector) (lux, for light of 1 lux); `color` divides it among the channels. For a surface
// that faces the caster's center this is Wyman's local irradiance. Because a vector is stored, a surface of
// any orientation receives the flux that crosses it.
struct VolumeLight {
  vec3 vector;  // mean over the channels
  vec3 color;   // sum over cells, weighted by their brightness; only ratios count
};

SHARED_FUNCTION VolumeLight noLight() {
  VolumeLight light;
  light.vector = vec3(0.0f);
  light.color = vec3(0.0f);
  return light;
}

// Adds a cell with a weight. A cell is three half floats for the vector, and 8 bits each for the red and the
// blue part of the light.
SHARED_FUNCTION void addCell(VolumeView volume, uint cell, float weight, INOUT(VolumeLight) light) {
  uint low = volumeWord(volume, kWordsOfCell * cell);
  uint high = volumeWord(volume, kWordsOfCell * cell + 1u);
  vec2 across = unpackHalf2x16(low);
  vec3 vector = weight * vec3(across.x, across.y, unpackHalf2x16(high).x);
  light.vector += vector;
  float red = float((high >> 16u) & 0xffu) / 255.0f;
  float blue = float(high >> 24u) / 255.0f;
  light.color += (abs(vector.x) + abs(vector.y) + abs(vector.z)) * vec3(red, 1.0f - red - blue, blue);
}

// Trilinear interpolation between the cells of a lattice, which begin after `first` other cells. `at`: from 0
// to size - 1. `corners`: 8, or 0 for no light. (A software device skips a loop that no thread enters, but it
// does not skip a branch.)
SHARED_FUNCTION VolumeLight latticeLight(VolumeView volume, uint first, uvec3 size, vec3 at, uint corners) {
  VolumeLight light = noLight();
  uvec3 corner = min(uvec3(at), max(size, uvec3(2u)) - 2u);
  uvec3 next = min(corner + 1u, size - 1u);
  vec3 part = at - vec3(corner);
  for (uint i = 0u; i < corners; ++i) {
    uvec3 bit = uvec3(i & 1u, (i >> 1u) & 1u, i >> 2u);
    uvec3 cell = corner + bit * (next - corner);
    vec3 weights = mix(1.0f - part, part, vec3(bit));
    addCell(volume, first + (cell.z * size.y + cell.y) * size.x + cell.x, weights.x * weights.y * weights.z,
            light);
  }
  return light;
}

SHARED_FUNCTION bool isBetween(vec3 place, vec3 end) {
  return min(min(place.x, place.y), place.z) >= 0.0f && place.x <= end.x && place.y <= end.y &&
         place.z <= end.z;
}

// The light of a grid whose cells begin after `first` other cells. `place`: in cells from the grid's corner;
// beyond the grid there is no light.
#ifdef __cplusplus
inline VolumeLight gridLight(VolumeView volume, uint first, vec3 place) {
  const vec3 end(volume.size);
  return latticeLight(volume, first, volume.size, clamp(place - 0.5f, vec3(0.0f), end - 1.0f),
                      isBetween(place, end) ? 8u : 0u);
}
#else
VolumeLight gridLight(VolumeView volume, uint first, vec3 place);
#endif

// The light of a multi-resolution volume. `place`: in cells of the finest grid. The volume's size is in
// bricks. It begins with a word for each brick: the index of its first cell and, in the two lowest bits, how
// many times each side is halved.
SHARED_FUNCTION VolumeLight brickLight(VolumeView volume, vec3 place) {
  vec3 end = vec3(volume.size * kBrickIntervals);
  vec3 at = clamp(place - 0.5f, vec3(0.0f), end);
  uvec3 brick = min(uvec3(at) / kBrickIntervals, volume.size - 1u);
  uint word = volumeWord(volume, (brick.z * volume.size.y + brick.y) * volume.size.x + brick.x);
  uint intervals = 1u << (word & 3u);
  vec3 within = (at - vec3(brick * kBrickIntervals)) * (float(intervals) / float(kBrickIntervals));
  return latticeLight(volume, word >> 2u, uvec3(intervals + 1u), within,
                      word != kDarkBrick && isBetween(place, end + 1.0f) ? 8u : 0u);
}

// Where a place (in radii of the region, from the center) lies in the shells. x and y: in cells of the
// octahedral map around the light's direction. z: the shell, with a fraction. Places beyond the last shell
// count as on it.
SHARED_FUNCTION vec3 placeInShells(VolumeView volume, vec3 place) {
  float radius = length(place);
  vec2 square = octahedralFromDirection(radius > 0.0f ? place / radius : vec3(0.0f, 0.0f, 1.0f));
  float reach = uintBitsToFloat(volumeWord(volume, 0u));
  vec2 across = ((square - 0.5f) / reach + 0.5f) * vec2(float(volume.size.x), float(volume.size.y));
  float along = min(radius, 1.0f) * float(kShellRadii);
  uint before = min(uint(along), kShellRadii - 1u);
  float shell = mix(uintBitsToFloat(volumeWord(volume, 1u + before)),
                    uintBitsToFloat(volumeWord(volume, 2u + before)), along - float(before));
  return vec3(across.x, across.y, shell);
}

SHARED_FUNCTION VolumeLight volumeLight(VolumeView volume, uint representation, vec3 place) {
  if (representation == kRepresentationMultiResolution) return brickLight(volume, place);
  if (representation != kRepresentationShells) return gridLight(volume, 0u, place);
  VolumeLight light = gridLight(volume, kShellWords / kWordsOfCell, placeInShells(volume, place));
  light.vector /= max(dot(place, place), kLeastShellSquare);
  return light;
}

// The displaced place from which the light of a place is taken, and how space is stretched there.
struct FlowedPlace {
  vec3 place;
  vec3 stretch[3];  // columns of the derivative of `place`
};

// Displaces a place by trilinear interpolation on a lattice of flow.side^3 displacements. The nodes lie where
// (place - flow.origin) * flow.scale is whole; beyond the lattice its border counts. No displacement where
// flow.side is 0.
SHARED_FUNCTION FlowedPlace flowedPlace(FlowView flow, vec3 place) {
  FlowedPlace flowed;
  vec3 end = vec3(float(max(flow.side, 2u) - 1u));
  vec3 at = (place - flow.origin) * flow.scale;
  vec3 inside = clamp(at, vec3(0.0f), end);
  uvec3 low = min(uvec3(inside), uvec3(end) - 1u);
  vec3 part = inside - vec3(low);
  vec3 move = vec3(0.0f), alongX = vec3(0.0f), alongY = vec3(0.0f), alongZ = vec3(0.0f);
  uint corners = flow.side > 0u ? 8u : 0u;
  for (uint i = 0u; i < corners; ++i) {
    uvec3 bit = uvec3(i & 1u, (i >> 1u) & 1u, i >> 2u);
    vec3 value = flowMove(flow, low + bit);
    vec3 weights = mix(1.0f - part, part, vec3(bit));
    vec3 sides = 2.0f * vec3(bit) - 1.0f;
    move += (weights.x * weights.y * weights.z) * value;
    alongX += (sides.x * weights.y * weights.z) * value;
    alongY += (weights.x * sides.y * weights.z) * value;
    alongZ += (weights.x * weights.y * sides.z) * value;
  }
  flowed.place = place + move;
  flowed.stretch[0] = vec3(1.0f, 0.0f, 0.0f) + (at.x == inside.x ? flow.scale.x : 0.0f) * alongX;
  flowed.stretch[1] = vec3(0.0f, 1.0f, 0.0f) + (at.y == inside.y ? flow.scale.y : 0.0f) * alongY;
  flowed.stretch[2] = vec3(0.0f, 0.0f, 1.0f) + (at.z == inside.z ? flow.scale.z : 0.0f) * alongZ;
  return flowed;
}

// The vector of displaced light. The flux through any surface equals the flux through its image (the Piola
// transform), so that flux is kept.
SHARED_FUNCTION vec3 carried(FlowedPlace from, vec3 vector) {
  return vec3(dot(cross(from.stretch[1], from.stretch[2]), vector),
              dot(cross(from.stretch[2], from.stretch[0]), vector),
              dot(cross(from.stretch[0], from.stretch[1]), vector));
}

SHARED_FUNCTION VolumeLight flowedLight(VolumeView volume, uint representation, FlowView flow, vec3 place) {
  FlowedPlace from = flowedPlace(flow, place);
  VolumeLight light = volumeLight(volume, representation, from.place);
  light.vector = carried(from, light.vector);
  return light;
}

// Stored light is used up to this distance from the region's center, in its radii: a little less than 1,
// because cells at the border are cut.
SHARED_CONSTANT float kRegionEdge = 0.93f;

// Beyond the region, light continues as if all of it came from the point `source`. Returns the place at the
// region's edge through which the light of `place` came (xyz), and the part of it that is left (w). Lengths
// are in the region's radii, from its center.
SHARED_FUNCTION vec4 placeInRegion(vec3 place, vec3 source) {
  if (dot(place, place) <= kRegionEdge * kRegionEdge) return vec4(place, 1.0f);
  vec3 away = place - source;
  float a = dot(away, away);
  float b = dot(source, away);
  float c = dot(source, source) - kRegionEdge * kRegionEdge;
  float square = b * b - a * c;
  float part = square >= 0.0f && a > 0.0f ? (sqrt(square) - b) / a : 0.0f;
  return part > 0.0f && part < 1.0f ? vec4(source + part * away, part * part) : vec4(0.0f);
}

// The light vector beyond the edge. At the edge the light is `vector`, and the edge's normal is `outward`
// (unit). It continues along `away` (unit, from the source). The flux through the edge is kept.
SHARED_FUNCTION vec3 spreadOn(vec3 vector, vec3 outward, vec3 away) {
  const float kLeastCosine = 0.1f;
  return (max(dot(vector, outward), 0.0f) / max(dot(away, outward), kLeastCosine)) * away;
}

// Treats a lamp near the caster as a light from afar. A projective map takes the place x (from the caster's
// center) to nearScale(x, nearness) * x. It makes the rays of a lamp at nearness / dot(nearness, nearness)
// parallel, and all other lines stay lines. So the image of the lamp behind a lens moves to the focus of the
// lens. For light from afar the nearness is zero. The result is 0 at the lamp and behind it.
SHARED_FUNCTION float nearScale(vec3 x, vec3 nearness) {
  const float kLeast = 0.02f;
  float part = 1.0f - dot(x, nearness);
  return part > kLeast ? 1.0f / part : 0.0f;
}

// The light vector at x, where the light is `vector` at the place to which the projective map takes x. Flux
// is kept (the Piola transform).
SHARED_FUNCTION vec3 nearVector(vec3 vector, vec3 x, vec3 nearness) {
  float scale = nearScale(x, nearness);
  return scale * scale * scale * (vector - dot(nearness, vector) * x);
}

// Illuminance (lux, per channel) on the front of a surface with the unit normal `normal`.
SHARED_FUNCTION vec3 surfaceIlluminance(VolumeLight light, vec3 normal) {
  float sum = light.color.x + light.color.y + light.color.z;
  float illuminance = max(-dot(normal, light.vector), 0.0f);
  return sum > 0.0f ? (3.0f * illuminance / sum) * light.color : vec3(0.0f);
}

SHARED_END

#endif
