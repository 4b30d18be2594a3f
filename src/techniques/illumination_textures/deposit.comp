// Leaves every beam's flux on every virtual plane: eq. 3 of Iwasaki 2005b, with the flux in place of intensity times area ratio,
// so that nothing is lost or made where a beam is narrower than a texel.
//
// The threads that share a beam stand in a block that moves over its footprint, a texel a thread: whatever their triangles' sizes
// and shapes, neighbouring threads go the same way.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/illumination_textures/shader_data.h"

#include "techniques/illumination_textures/receiver_normal.glsl.h"

layout(constant_id = 0) const uint kChannels = 3;
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Constants { DepositConstants constants; };

const uint kBlockWidth = 4;
const uint kBlockHeight = kThreadsOfBeam / kBlockWidth;

uint thread;        // among those of the beam
uint firstTexel;    // of the plane in the textures, in texels
vec2 slopes;        // m along axisU and axisV that the beam goes for each metre along axisW
vec3 unitsOfFlux;   // of the beam, by channel

// Puts a part of the beam's flux on a texel, as the illuminance of what the virtual camera sees there.
void add(vec2 place, float part) {
  const uint side = constants.set.textureSize;
  if (any(lessThan(place, vec2(0))) || any(greaterThanEqual(place, vec2(side)))) return;
  const uint texel = uint(place.y) * side + uint(place.x);
  const vec3 normal = unpackedNormal(constants.normals.word[texel]);
  // The beam's angle with the surface over that with the plane, as cosines.
  const float cosines = max(normal.z - dot(slopes, normal.xy), 0) * inversesqrt(dot(normal, normal));
  const vec3 units = unitsOfFlux * (part * cosines) + 0.5;
  const uint word = (firstTexel + texel) * kChannels;
  for (uint c = 0; c < kChannels; ++c)
    if (units[c] >= 1.0) atomicAdd(constants.textures.units[word + c], uint(units[c]));
}

void addSliver(vec2 a, vec2 b, vec2 c) {
  const float peak = sortSliver(a, b, c);
  const int steps = sliverSteps(a, c);
  for (int i = int(thread); i < steps; i += int(kThreadsOfBeam)) {
    const float part = tentBefore(float(i + 1) / float(steps), peak) - tentBefore(float(i) / float(steps), peak);
    add(floor(a + ((float(i) + 0.5) / float(steps)) * (c - a)), part);
  }
}

void addTriangle(vec2 a, vec2 b, vec2 c) {
  const vec2 lower = floor(min(min(a, b), c));
  const vec2 upper = floor(max(max(a, b), c));
  if (lower == upper) {
    if (thread == 0) add(lower, 1);
    return;
  }
  const vec2 end = vec2(constants.set.textureSize);
  if (any(lessThan(upper, vec2(0))) || any(greaterThanEqual(lower, end))) return;
  vec2 localA = a, localB = b, localC = c, base;
  centerFootprint(localA, localB, localC, base);
  if (isSliver(localA, localB, localC)) {
    addSliver(a, b, c);
    return;
  }
  const float perArea = 2.0 / abs(doubledArea(localA, localB, localC));
  const vec3 slopesOfSides = sideSlopes(localA, localB, localC);
  const vec2 last = min(upper, end - 1);
  for (float y = max(lower.y, 0) + float(thread / kBlockWidth); y <= last.y; y += float(kBlockHeight)) {
    const TriangleRow row = triangleInRow(localA, localB, localC, slopesOfSides, y - base.y);
    const float lastX = min(floor(row.last) + base.x, last.x);
    for (float x = max(floor(row.first) + base.x, 0) + float(thread % kBlockWidth); x <= lastX; x += float(kBlockWidth))
      add(vec2(x, y), triangleCoverage(row, x - base.x) * perArea);
  }
}

void addBeam(Beam beam, PlaneGrid grid) {
  vec2 texel[3];
  bvec3 meets;
  float along;
  for (int i = 0; i < 3; ++i) meets[i] = meetPlane(beam.position[i], beam.direction[i], grid, texel[i], along);
  if (all(meets)) {
    addTriangle(texel[0], texel[1], texel[2]);
  } else if (thread == 0 ? meets.x : thread == 1 ? meets.y : thread == 2 && meets.z) {
    add(floor(thread == 0 ? texel[0] : thread == 1 ? texel[1] : texel[2]), 1.0 / 3.0);
  }
}

void main() {
  const uint index = gl_GlobalInvocationID.x / kThreadsOfBeam;
  if (index >= constants.beamCount) return;
  thread = gl_GlobalInvocationID.x % kThreadsOfBeam;
  const Beam beam = constants.beams.beam[index];
  const vec3 direction = beam.direction[0] + beam.direction[1] + beam.direction[2];
  const float approach = dot(direction, constants.set.axisW);
  if (approach < kLeastApproach * length(direction)) return;
  slopes = vec2(dot(direction, constants.set.axisU), dot(direction, constants.set.axisV)) / approach;
  unitsOfFlux = beam.flux / constants.set.luxMetresSquaredPerUnit;
  for (uint plane = 0; plane < constants.set.planes; ++plane) {
    firstTexel = textureStart(constants.set, plane, constants.window, 1);
    addBeam(beam, planeGrid(constants.set, plane, constants.window));
  }
}
