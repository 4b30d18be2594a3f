// The receiver that glass reflects (Fresnel), on the side of the viewer.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "render/sight/sight_data.h"

#include "optics/refraction.h"
#include "render/sight/find_receiver.glsl.h"

layout(push_constant, scalar) uniform Constants { SightConstants constants; };
layout(set = 0, binding = 0) uniform utexture2DArray surroundings;
layout(set = 0, binding = 1) uniform texture2DArray surroundingDepths;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 receiverPosition;
layout(location = 1) out vec4 receiverNormal;  // a = reflectance
layout(location = 2) out vec4 receiverAlbedo;

void main() {
  const vec3 incident = normalize(position - constants.eye);
  const vec3 facing = normalize(gl_FrontFacing ? normal : -normal);
  const float cosine = clamp(-dot(incident, facing), 0, 1);
  const float eta = gl_FrontFacing ? 1 / constants.ior : constants.ior;
  float reflectance = fresnelReflectance(cosine, eta);
  if ((constants.marks & kSightThinWalled) != 0) reflectance = 2 * reflectance / (1 + reflectance);
  const FoundReceiver found = findAround(position, reflectDirection(incident, facing), constants.center, constants.reach,
                                         surroundings, surroundingDepths);
  const bool isFound = found.distance >= 0;
  receiverPosition = isFound ? vec4(found.position, 1) : vec4(0);
  receiverNormal = vec4(isFound ? found.normal : vec3(0), reflectance);
  receiverAlbedo = isFound ? found.albedo : vec4(0);
}
