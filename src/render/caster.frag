// The nearest caster in front of the receiver.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/frame_data.h"

layout(push_constant, scalar) uniform Constants { SurfaceConstants constants; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 casterNormal;  // on the side of the viewer; a = object + 1

void main() { casterNormal = vec4(normalize(gl_FrontFacing ? normal : -normal), constants.object + 1); }
