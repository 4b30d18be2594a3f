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
layout(location = 0) out vec4 target;

void main() {
  target = color;
}
