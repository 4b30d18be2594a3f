#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/illumination_textures/shader_data.h"

#include "techniques/illumination_textures/receiver_normal.glsl.h"

layout(push_constant, scalar) uniform Constants { ViewConstants constants; };
layout(location = 0) in vec3 normal;
layout(location = 0) out uint receiverNormal;  // toward the light

void main() {
  const vec3 inFrame = vec3(dot(normal, constants.set.axisU), dot(normal, constants.set.axisV), -dot(normal, constants.set.axisW));
  receiverNormal = packedNormal(inFrame.z < 0 ? -inFrame : inFrame);
}
