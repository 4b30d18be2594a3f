#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/illumination_textures/shader_data.h"

layout(push_constant, scalar) uniform Constants { ViewConstants constants; };
layout(location = 0) in vec3 normal;
layout(location = 1) in float depth;
layout(location = 0) out vec4 normalAndDepth;  // unit, toward the light; m along axisW

void main() {
  const vec3 axis = constants.set.axisW;
  const vec3 unit = normalize(normal);
  normalAndDepth = vec4(dot(unit, axis) < 0 ? unit : -unit, depth);
}
