// The nearest caster in front of the receiver.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/frame_data.h"

#include "optics/refraction.h"

layout(push_constant, scalar) uniform Constants { SurfaceConstants constants; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texcoord;
layout(location = 0) out vec4 casterNormal;       // on the side of the viewer; a = object + 1
layout(location = 1) out vec4 casterReflectance;  // a = 1 where it lets nothing through

void main() {
  const vec3 unit = normalize(gl_FrontFacing ? normal : -normal);
  const float cosine = clamp(dot(normalize(constants.eye - position), unit), 0, 1);
  casterNormal = vec4(unit, constants.object + 1);
  casterReflectance = constants.ior > 0 ? vec4(vec3(fresnelReflectance(cosine, 1 / constants.ior)), 0)
                                        : vec4(constants.color, 1);
}
