// The receiver that is seen through glass, or in a mirror, in place of the one behind it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "render/sight/sight_data.h"

#include "render/sight/find_receiver.glsl.h"

layout(push_constant, scalar) uniform Constants { SightConstants constants; };
layout(set = 0, binding = 0) uniform utexture2DArray slices;
layout(set = 0, binding = 1) uniform texture2DArray sliceDepths;
layout(set = 0, binding = 2) uniform utexture2DArray surroundings;
layout(set = 0, binding = 3) uniform texture2DArray surroundingDepths;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 exit;
layout(location = 3) in vec3 direction;
layout(location = 4) in vec3 transmittance;
layout(location = 0) out vec4 receiverPosition;
layout(location = 1) out vec4 receiverNormal;
layout(location = 2) out vec4 receiverAlbedo;
layout(location = 3) out vec4 throughCaster;  // a = kSight...

void main() {
  const vec3 along = normalize(direction);
  FoundReceiver found = findInSlices(exit, along, constants.slices, slices, sliceDepths);
  if (found.distance < 0)
    found = findAround(exit, along, constants.center, constants.reach, surroundings, surroundingDepths);
  const bool isFound = found.distance >= 0;
  receiverPosition = isFound ? vec4(found.position, 1) : vec4(0);
  receiverNormal = isFound ? vec4(found.normal, 0) : vec4(0);
  receiverAlbedo = isFound ? found.albedo : vec4(0);
  throughCaster = vec4(transmittance, float(constants.marks));
}
