// A triangle that covers every texel of the targets, with what is said of the air and of the ray of sight
// there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/air/air_data.h"

layout(constant_id = 5) const bool kHasAir = true;
layout(push_constant, scalar) uniform Constants {
  BUFFER_ADDRESS(AirLights) air;  // the first of what a light's pass has
}
constants;
layout(location = 0) flat out Air air;
layout(location = 5) flat out AirPlanes planes;
layout(location = 8) flat out vec3 eye;
layout(location = 9) flat out vec3 depths;  // nearest, pace, stride of AirSight
layout(location = 10) noperspective out vec3 ray;
layout(location = 11) flat out AirBox box;

void main() {
  const vec2 place = vec2(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1);
  gl_Position = vec4(place, 0, 1);
  air = Air(0, 0, 0, 0, 0);
  planes = AirPlanes(0, 0, 0);
  box = AirBox(vec3(0), vec3(0), 0);
  eye = depths = ray = vec3(0);
  if (!kHasAir) return;
  const AirLight light = constants.air.light[0];
  air = light.air;
  planes = light.planes;
  box = light.box;
  eye = light.sight.eye;
  depths = vec3(light.sight.nearest, light.sight.pace, float(light.sight.stride));
  ray = light.sight.middle + place.x * light.sight.right + place.y * light.sight.down;
}
