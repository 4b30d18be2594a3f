// The nearest caster in front of the receiver.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/frame_data.h"

layout(push_constant, scalar) uniform Constants { SurfaceConstants constants; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texcoord;
layout(location = 0) out vec4 casterPosition;  // a = object + 1
layout(location = 1) out vec4 casterNormal;    // on the side of the viewer; a = material + 1

void main() {
  const uint material = constants.objects.object[constants.object].material;
  casterPosition = vec4(position, constants.object + 1);
  casterNormal = vec4(normalize(gl_FrontFacing ? normal : -normal), material + 1);
}
