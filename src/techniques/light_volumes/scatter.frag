// Adds what a medium scatters toward the eye of the light that crosses it in layers, along each pixel's way
// through it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "techniques/light_volumes/scatter_data.h"

#include "core/octahedral.h"
#include "geometry/box.h"
#include "optics/phase.h"

layout(push_constant, scalar) uniform Constants {
  ScatterConstants constants;
};
uniform texture2D wayStart;  // m; a = its length, 0 where there is none
// Octahedral direction, away from the eye; part of what comes to the way's start that comes to the eye; m in
// the volume before it.
uniform texture2D wayDirection;
uniform sampler2DArray layers;
layout(location = 0) out vec4 luminance;

const float kTexelsInStep = 1.5, kLayersInStep = 0.5;
const float kFewestSteps = 8, kMostSteps = 64;

vec4 lightAt(vec3 place) {
  const float low = clamp(floor(place.z), 0, constants.grid.layers - 2);
  const vec2 at = place.xy / constants.grid.size;
  return mix(textureLod(layers, vec3(at, low), 0), textureLod(layers, vec3(at, low + 1), 0),
             clamp(place.z - low, 0, 1));
}

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const vec4 start = texelFetch(wayStart, pixel, 0), packedDirection = texelFetch(wayDirection, pixel, 0);
  const vec3 direction = directionFromOctahedral(packedDirection.xy);
  const float part = packedDirection.z, before = packedDirection.w;
  const LayerGrid grid = constants.grid;
  const vec3 begin = placeInLayers(grid, start.xyz);
  const vec3 perMeter = placeInLayers(grid, start.xyz + direction) - begin;
  const vec2 inside = wayThroughBox(vec3(0), vec3(grid.size, grid.layers - 1), begin, perMeter, start.a);
  const float way = max(inside.y - inside.x, 0);
  const float changes = way * max(length(perMeter.xy) / kTexelsInStep, abs(perMeter.z) / kLayersInStep);
  const int steps = start.a > 0 && way > 0 ? int(clamp(ceil(changes), kFewestSteps, kMostSteps)) : 0;
  const float step = way / float(max(steps, 1));
  vec3 sum = vec3(0);
  for (int i = 0; i < steps; ++i) {
    const float along = inside.x + (float(i) + 0.5) * step;
    const vec4 light = lightAt(begin + along * perMeter);
    const float lux = max(light.x, 1e-20);
    const vec3 travels = normalize(grid.axisW + light.y / lux * grid.axisU + light.z / lux * grid.axisV);
    const float phase = phaseFunction(constants.phase, constants.g, -dot(travels, direction));
    sum += light.x * phase * exp(-constants.extinction * (before + along + light.w / lux));
  }
  luminance = vec4(sum * constants.scattering * (step * part), 0);
}
