// What is known of sight at the nearest caster. Where it ends is looked for afterwards, in whole blocks of
// pixels: triangles of a few pixels each would fill them badly.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/sight/sight_data.h"

#include "render/sight/slice_texel.glsl.h"

layout(push_constant, scalar) uniform Constants {
  CasterConstants constants;
};
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 exit;
layout(location = 3) in vec4 direction;
layout(location = 4) in vec3 transmittance;
layout(location = 5) in vec3 receiverNormal;
layout(location = 6) in vec4 receiverColor;
layout(location = 7) flat in uint receiverMaterial;
layout(location = 0) out vec4 casterPosition;  // a = number of the caster
layout(location = 1) out vec4
    casterNormal;  // on the side of the viewer; a = 1, or -1 where that is the inside
layout(location = 2) out vec4 casterExit;
layout(location = 3) out vec4 casterDirection;
layout(location = 4) out vec4 throughCaster;  // a = kSight...
layout(location = 5)
    out uvec4 receiver;  // normal, octahedral; albedo as packSliceAlbedo has it; 1 where it is known

void main() {
  casterPosition = vec4(position, float(constants.number));
  casterNormal = gl_FrontFacing ? vec4(normal, 1) : vec4(-normal, -1);
  casterExit = exit;
  casterDirection = direction;
  throughCaster = vec4(transmittance, float(constants.marks));
  receiver = uvec4(packUnorm2x16(octahedralFromDirection(normalize(receiverNormal))),
                   packSliceAlbedo(receiverColor.rgb, receiverMaterial), receiverColor.a > 0.999 ? 1u : 0u);
}
