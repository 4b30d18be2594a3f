// A dielectric's surface in front of a receiver, as seen by a ray that goes straight through: what it reflects and what it takes
// away. Surfaces add up in any order: one that the ray enters by adds the length from it to the receiver, one that it leaves by
// takes that off again.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/frame_data.h"

#include "optics/refraction.h"

layout(push_constant, scalar) uniform Constants { SurfaceConstants constants; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D receiverPosition;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 opticalDepth;  // rgb of absorption, a of Fresnel reflection
layout(location = 1) out vec4 reflectance;   // of the surfaces that the ray enters by

void main() {
  const vec4 receiver = imageLoad(receiverPosition, ivec2(gl_FragCoord.xy));
  // Without a receiver every way in has a way out, and the lengths are counted from the eye.
  const float end = receiver.a > 0 ? distance(receiver.xyz, constants.eye) : 0;
  const vec3 fromEye = position - constants.eye;
  const float start = length(fromEye);
  const float inside = gl_FrontFacing ? end - start : start - end;
  const float cosine = min(abs(dot(fromEye, normalize(normal))) / start, 1);
  const float reflected = fresnelReflectance(cosine, 1 / constants.ior);
  opticalDepth = vec4(constants.color * inside, -log(max(1 - reflected, 1e-3)));
  reflectance = vec4(vec3(gl_FrontFacing ? reflected : 0), 0);
}
