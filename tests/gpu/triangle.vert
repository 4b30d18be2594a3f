#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/buffer_address.h"

layout(buffer_reference, scalar) readonly buffer Corners {
  vec3 corner[];
};
layout(push_constant, scalar) uniform Constants {
  Corners corners;
  vec4 color;
};

void main() {
  gl_Position = vec4(corners.corner[gl_VertexIndex], 1);
}
