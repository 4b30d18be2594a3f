#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/buffer_address.h"
#include "optics/refraction.h"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar) readonly buffer Directions {
  vec3 direction[];
};
layout(buffer_reference, scalar) writeonly buffer Results {
  vec4 result[];
};
layout(push_constant, scalar) uniform Constants {
  Directions directions;
  Results results;
  uint count;
  float eta;
};

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  // The whole vector at once: see gpu/buffer_address.h.
  const vec3 direction = directions.direction[i];
  vec3 transmitted;
  refractDirection(direction, vec3(0, 1, 0), eta, transmitted);
  results.result[i] = vec4(transmitted, fresnelReflectance(-direction.y, eta));
}
