// How much air lies between a light, or the eye, and each node of the box.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/air/air_data.h"

#include "render/air/box.glsl.h"

layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;
layout(push_constant, scalar) uniform Constants {
  AirDepthConstants constants;
};
uniform sampler2DArray density;
layout(rgba16f) uniform writeonly image2DArray depths;

const int kMostSteps = 128;

void main() {
  const uvec3 node = gl_GlobalInvocationID;
  if (any(greaterThanEqual(node, uvec3(kAirNodes)))) return;
  const AirBox box = AirBox(constants.corner, 1 / constants.size, 0);
  const vec3 point = constants.corner + vec3(node) / float(kAirNodes - 1u) * constants.size;
  const float way = distance(point, constants.source);
  const vec3 direction = (point - constants.source) / max(way, 1e-9);
  const vec2 part = wayThroughBox(box, constants.source, direction, way);
  const vec3 cell = constants.size / vec3(textureSize(density, 0));
  const int steps = clamp(int(ceil((part.y - part.x) / min(cell.x, min(cell.y, cell.z)))), 0, kMostSteps);
  const float step = (part.y - part.x) / float(max(steps, 1));
  float sum = 0;
  for (int i = 0; i < steps; ++i)
    sum += boxDensity(density, box, constants.source + (part.x + (float(i) + 0.5) * step) * direction);
  imageStore(depths, ivec3(node.xy, constants.firstLayer + node.z), vec4(sum * step));
}
