// Luminance (nit) toward the viewer, and the picture of it. Glass is its Fresnel reflection of the background and a view straight
// through.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/frame_data.h"

#include "render/tone_mapping.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kWritesLayers = false;
layout(constant_id = 1) const bool kHasEmission = false;  // does any receiver shine by itself
layout(constant_id = 2) const bool kSeesCasters = false;  // may one be in front of a receiver here
layout(push_constant, scalar) uniform Constants { CompositeConstants constants; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D receiverAlbedo;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D directLux;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D causticsLux;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D casterReflectance;
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D opticalDepth;
layout(set = 0, binding = 5, rgba8) uniform writeonly image2D picture;
layout(set = 0, binding = 6, rgba32f) uniform writeonly image2D luminance;
layout(set = 0, binding = 7, rgba32f) uniform writeonly image2D directLuminance;
layout(set = 0, binding = 8, rgba32f) uniform writeonly image2D causticsLuminance;

const float kInversePi = 0.318309886;

void main() {
  if (any(greaterThanEqual(gl_GlobalInvocationID.xy, uvec2(constants.size)))) return;
  const ivec2 pixel = constants.corner + ivec2(gl_GlobalInvocationID.xy);
  vec3 rest = constants.background;
  vec3 direct = vec3(0);
  vec3 caustics = vec3(0);
  const vec4 albedo = imageLoad(receiverAlbedo, pixel);
  if (albedo.a > 0) {
    const vec3 reflectance = albedo.rgb * kInversePi;  // 1/sr
    direct = reflectance * imageLoad(directLux, pixel).rgb;
    caustics = reflectance * imageLoad(causticsLux, pixel).rgb;
    rest = reflectance * constants.ambient;
    if (kHasEmission) rest += constants.materials.material[uint(albedo.a) - 1].emission;
  }
  if (kSeesCasters) {
    const vec4 caster = imageLoad(casterReflectance, pixel);
    const vec4 depth = max(imageLoad(opticalDepth, pixel), vec4(0));
    const vec3 transmittance = (1 - caster.a) * exp(-depth.rgb - depth.a);
    direct *= transmittance;
    caustics *= transmittance;
    rest = rest * transmittance + min(caster.rgb, vec3(1)) * constants.background;
  }
  const vec3 total = direct + caustics + rest;
  imageStore(picture, pixel, vec4(displayed(total, constants.exposure), 1));
  if (kWritesLayers) {
    imageStore(luminance, pixel, vec4(total, 1));
    imageStore(directLuminance, pixel, vec4(direct, 1));
    imageStore(causticsLuminance, pixel, vec4(caustics, 1));
  }
}
