// Luminance (nit) toward the viewer. Glass is its Fresnel reflection of the background and a view straight through.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/frame_data.h"

#include "optics/refraction.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kWritesLayers = false;
layout(push_constant, scalar) uniform Constants { CompositeConstants constants; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D receiverAlbedo;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D directLux;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D causticsLux;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D casterNormal;
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D opticalDepth;
layout(set = 0, binding = 5, rgba32f) uniform writeonly image2D luminance;
layout(set = 0, binding = 6, rgba32f) uniform writeonly image2D directLuminance;
layout(set = 0, binding = 7, rgba32f) uniform writeonly image2D causticsLuminance;

const float kInversePi = 0.318309886;

// What a caster in front sends on from the surroundings, and what it leaves of what is behind it.
void lookThrough(ivec2 pixel, vec4 caster, out vec3 reflected, out vec3 transmittance) {
  const SceneMaterial material = constants.materials.material[uint(caster.a) - 1];
  if (material.type == kMaterialMirror) {
    reflected = material.color * constants.background;
    transmittance = vec3(0);
    return;
  }
  const vec2 place = (vec2(pixel) + 0.5) / vec2(imageSize(luminance)) * 2 - 1;
  const vec3 view = normalize(constants.forward + place.x * constants.right - place.y * constants.up);
  reflected = fresnelReflectance(min(abs(dot(view, caster.xyz)), 1), 1 / material.ior) * constants.background;
  const vec4 depth = max(imageLoad(opticalDepth, pixel), vec4(0));
  transmittance = exp(-depth.rgb - depth.a);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(luminance)))) return;
  vec3 rest = constants.background;
  vec3 direct = vec3(0);
  vec3 caustics = vec3(0);
  const vec4 lux = imageLoad(directLux, pixel);
  if (lux.a > 0) {
    const vec4 albedo = imageLoad(receiverAlbedo, pixel);
    const vec3 reflectance = albedo.rgb * kInversePi;  // 1/sr
    direct = reflectance * lux.rgb;
    caustics = reflectance * imageLoad(causticsLux, pixel).rgb;
    rest = reflectance * constants.ambient + constants.materials.material[uint(albedo.a)].emission;
  }
  const vec4 caster = imageLoad(casterNormal, pixel);
  if (caster.a > 0) {
    vec3 reflected, transmittance;
    lookThrough(pixel, caster, reflected, transmittance);
    direct *= transmittance;
    caustics *= transmittance;
    rest = rest * transmittance + reflected;
  }
  imageStore(luminance, pixel, vec4(direct + caustics + rest, 1));
  if (kWritesLayers) {
    imageStore(directLuminance, pixel, vec4(direct, 1));
    imageStore(causticsLuminance, pixel, vec4(caustics, 1));
  }
}
