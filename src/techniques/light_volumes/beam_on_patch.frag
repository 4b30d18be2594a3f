// Adds to a pixel the light of a beam (Barczak and Olano, 3.1 and 3.2, without planes and stencils): what
// part of the beam's footprint on the receiver the pixel's own square there holds. So no flux is lost or made
// where beams are narrower than a pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "techniques/light_volumes/shader_data.h"

#include "techniques/light_volumes/receiver_square.glsl.h"

layout(constant_id = 0) const uint kIsStill = 0;  // the flat-water approximation of the cosine
uniform texture2D receiverPosition;
uniform texture2D axesU;
uniform texture2D axesV;
layout(location = 0) flat in vec4 positions[3];
layout(location = 3) flat in vec4 directions[3];
layout(location = 6) flat in vec4 stillAndPatch;
layout(location = 7) flat in vec3 extinction;
layout(location = 0) out vec4 causticsLux;

// The part of the beam's flux that the square holds; `cosine` is the mean of the corners' with the receiver,
// `meanWay` that of how far (m) they come.
float shareOf(ReceiverSquare square, out float cosine, out float meanWay) {
  vec2 corners[3];
  vec3 lit;
  float steepest = 1, sum = 0, ways = 0;
  for (int i = 0; i < 3; ++i) {
    const float approach = -dot(directions[i].xyz, square.normal);
    const vec3 ahead = square.point - positions[i].xyz;
    const float way = -dot(ahead, square.normal) / max(approach, 1e-4);
    const vec3 offset = way * directions[i].xyz - ahead;
    corners[i] = vec2(dot(offset, square.axisU), dot(offset, square.axisV));
    const float tolerance = reachTolerance(positions[i].w, length(offset));
    lit[i] = way >= -tolerance && way <= positions[i].w + tolerance ? 1 : 0;
    steepest = min(steepest, approach);
    sum += approach;
    ways += max(way, 0);
  }
  cosine = sum / 3;
  meanWay = ways / 3;
  // Corners hidden by what stands before: the light fades toward them.
  const vec2 a = corners[0], b = corners[1], c = corners[2];
  const float all = doubledArea(a, b, c);
  const vec3 weights =
      vec3(doubledArea(vec2(0), b, c), doubledArea(a, vec2(0), c), doubledArea(a, b, vec2(0)));
  const vec3 inside = clamp(weights * sign(all), vec3(0), vec3(abs(all)));
  const float part = lit == vec3(1) ? 1 : dot(lit, inside) / max(dot(inside, vec3(1)), 1e-30);
  return steepest < 1e-3 || lit == vec3(0) ? 0 : part * shareInTexel(a + 0.5, b + 0.5, c + 0.5);
}

void main() {
  const ivec2 at = ivec2(gl_FragCoord.xy);
  const vec4 u = texelFetch(axesU, at, 0), v = texelFetch(axesV, at, 0);
  const ReceiverSquare square = squareFromTexels(texelFetch(receiverPosition, at, 0).xyz, u, v);
  float cosine, way;
  float share = shareOf(square, cosine, way);
  if (v.w != stillAndPatch.w) share = 0;  // another patch's pixel
  if (kIsStill != 0) share *= max(-dot(stillAndPatch.xyz, square.normal), 0) / max(cosine, 1e-3);
  const vec3 flux = vec3(directions[0].w, directions[1].w, directions[2].w) * exp(-way * extinction);
  causticsLux = vec4(flux * (share * abs(square.inverseArea)), 0);
}
