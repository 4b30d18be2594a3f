// The nearest mirror in front of the receiver.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/frame_data.h"

layout(push_constant, scalar) uniform Constants { SurfaceConstants constants; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 opticalDepth;
layout(location = 1) out vec4 reflectance;  // a = 1: nothing is seen through it

void main() {
  opticalDepth = vec4(0);
  reflectance = vec4(constants.color, 1);
}
