#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/planes/receiver_normal.glsl.h"

layout(location = 0) in vec3 normal;
layout(location = 0) out uint receiverNormal;  // toward the virtual camera

void main() {
  receiverNormal = packedNormal(normal.z < 0 ? -normal : normal);
}
