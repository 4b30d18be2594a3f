// Leaves every beam's flux on every virtual plane: eq. 3 of Iwasaki 2005b, with the flux in place of intensity times area ratio,
// so that nothing is lost or made where a beam is narrower than a texel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "techniques/illumination_textures/shader_data.h"

layout(constant_id = 0) const uint kChannels = 3;
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Constants { DepositConstants constants; };
layout(set = 0, binding = 0) uniform texture2DArray receivers;  // normal toward the light and depth, a layer a window

uint firstWord;
int window;
vec3 direction;      // of the beam where it crosses the plane
float cosDelta;      // between the beam and the plane's normal
vec3 unitsOfFlux;    // of the beam, by channel

// Puts a part of the beam's flux on a texel, as the illuminance of what the virtual camera sees there.
void add(ivec2 texel, float part) {
  if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(constants.set.textureSize)))) return;
  const vec3 normal = texelFetch(receivers, ivec3(texel, window), 0).xyz;
  const float cosGamma = max(-dot(direction, normal), 0.0);
  const vec3 units = unitsOfFlux * (part * cosGamma / cosDelta) + 0.5;
  const uint word = firstWord + (uint(texel.y) * constants.set.textureSize + uint(texel.x)) * kChannels;
  for (uint c = 0; c < kChannels; ++c)
    if (units[c] >= 1.0) atomicAdd(constants.textures.units[word + c], uint(units[c]));
}

void addSliver(vec2 a, vec2 b, vec2 c) {
  const float peak = sortSliver(a, b, c);
  const int steps = sliverSteps(a, c);
  float before = 0;
  for (int i = 0; i < steps; ++i) {
    const float after = tentBefore(float(i + 1) / float(steps), peak);
    add(ivec2(floor(a + ((float(i) + 0.5) / float(steps)) * (c - a))), after - before);
    before = after;
  }
}

void addTriangle(vec2 a, vec2 b, vec2 c) {
  const vec2 lower = floor(min(min(a, b), c));
  const vec2 upper = floor(max(max(a, b), c));
  if (lower == upper) {
    add(ivec2(lower), 1);
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
  const vec2 first = max(lower, vec2(0));
  const vec2 last = min(upper, end - 1);
  for (float y = first.y; y <= last.y; ++y)
    for (float x = first.x; x <= last.x; ++x) {
      const float covered = triangleCoverage(localA, localB, localC, vec2(x, y) - base);
      if (covered > 0) add(ivec2(x, y), covered * perArea);
    }
}

// Whether the outer window is asked for nothing this footprint lies on, because the inner one holds it, a texel's border included.
bool innerWindowHolds(vec2 texel[3]) {
  const float scale = constants.set.windows[0].texelsPerMetre / constants.set.windows[1].texelsPerMetre;
  const vec2 offset = (constants.set.windows[1].corner - constants.set.windows[0].corner) * constants.set.windows[0].texelsPerMetre;
  const vec2 least = min(min(texel[0], texel[1]), texel[2]) * scale + offset;
  const vec2 most = max(max(texel[0], texel[1]), texel[2]) * scale + offset;
  const float border = 1 + 2 * scale;
  return all(greaterThan(least, vec2(border))) && all(lessThan(most, vec2(float(constants.set.textureSize) - border)));
}

void main() {
  if (gl_GlobalInvocationID.x >= constants.beamCount) return;
  const uint plane = gl_GlobalInvocationID.y % constants.set.planes;
  window = int(gl_GlobalInvocationID.y / constants.set.planes);
  firstWord = textureStart(constants.set, plane, uint(window), kChannels);
  const PlaneGrid grid = planeGrid(constants.set, plane, uint(window));
  const Beam beam = constants.beams.beam[gl_GlobalInvocationID.x];

  direction = normalize(beam.direction[0] + beam.direction[1] + beam.direction[2]);
  cosDelta = dot(direction, constants.set.axisW);
  if (cosDelta < kLeastApproach) return;
  unitsOfFlux = beam.flux / constants.set.luxMetresSquaredPerUnit;

  vec2 texel[3];
  bvec3 meets;
  float along;
  for (int i = 0; i < 3; ++i) meets[i] = meetPlane(beam.position[i], beam.direction[i], grid, texel[i], along);
  if (all(meets)) {
    if (window == 0 || !innerWindowHolds(texel)) addTriangle(texel[0], texel[1], texel[2]);
  } else {
    for (int i = 0; i < 3; ++i)
      if (meets[i]) add(ivec2(floor(texel[i])), 1.0 / 3.0);
  }
}
