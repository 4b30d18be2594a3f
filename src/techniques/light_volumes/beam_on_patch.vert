// A square of pixels, with a beam that may light them.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "techniques/light_volumes/shader_data.h"

#include "techniques/light_volumes/beam_texels.glsl.h"

layout(push_constant, scalar) uniform Constants {
  BeamDrawConstants constants;
};
uniform utexture2D beamTexels;
layout(location = 0) flat out vec4 positions[3];   // a: the reach
layout(location = 3) flat out vec4 directions[3];  // a: a channel of the flux
layout(location = 6) flat out vec4 stillAndPatch;
layout(location = 7) flat out vec3 extinction;

void main() {
  const BeamDraw draw = constants.draws.draw[gl_VertexIndex];
  vec4 texels[6];
  const ivec2 texel = firstTexel(draw.beam, kTexelsOfBeam);
  for (int i = 0; i < 6; ++i) texels[i] = uintBitsToFloat(texelFetch(beamTexels, texel + ivec2(i, 0), 0));
  const Beam beam = beamFromTexels(texels);
  for (int i = 0; i < 3; ++i) {
    positions[i] = vec4(beam.position[i], beam.reach[i]);
    directions[i] = vec4(beam.direction[i], beam.flux[i]);
  }
  const BeamPortion portion = constants.portions.portion[draw.portion];
  stillAndPatch = vec4(portion.still, float(draw.square >> 8));
  extinction = portion.extinction;
  const float size = float(draw.square & 0xffu);
  const vec2 corner = vec2(draw.corner & 0xffffu, draw.corner >> 16);
  // A point is drawn only if its middle is in the image.
  const vec2 middle = min(corner + 0.5 * size, constants.imageSize - 0.5);
  gl_Position = vec4(2 * middle / constants.imageSize - 1, 0, 1);
  gl_PointSize = size;
}
