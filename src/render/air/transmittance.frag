// How much of the light from what a pixel sees the air before it lets through (Dobashi 2002, eq. 1), and no
// shafts yet.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "render/air/air_data.h"

#include "render/air/box.glsl.h"

uniform texture2D depthImage;
layout(location = 0) flat in Air air;
layout(location = 8) flat in vec3 eye;
layout(location = 9) flat in vec3 depths;
layout(location = 10) noperspective in vec3 ray;
layout(location = 11) flat in AirBox box;
uniform sampler2DArray boxDepths;
layout(location = 0) out vec4 shafts;

void main() {
  const float depth = texelFetch(depthImage, ivec2(gl_FragCoord.xy), 0).r;
  const float along = depth > 0 ? depths.x / depth : kFarthestAir / length(ray);
  float way = meanFogDensity(air, eye.y, eye.y + along * ray.y) * along * length(ray);
  if (kHasBox) way = boxDepthBetween(boxDepths, box, eye, eye + along * ray, 0);
  shafts = vec4(vec3(0), exp(-air.extinction * way));
}
