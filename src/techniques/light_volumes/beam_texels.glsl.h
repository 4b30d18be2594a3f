// Beams and their bounds in images with 128 bits per texel, which a software device reads faster than
// buffers. Each element has `texels` texels.
ivec2 firstTexel(uint index, uint texels) {
  const uint inRow = kTexelsInRow / texels;
  return ivec2(texels * (index % inRow), index / inRow);
}

BeamBounds boundsFromTexels(uvec4 a, uvec4 b, uvec4 c, uvec4 d) {
  const vec4 crossing = uintBitsToFloat(a), slope = uintBitsToFloat(b), along = uintBitsToFloat(c);
  return BeamBounds(crossing.xy, crossing.zw, slope.xy, slope.zw, along.x, along.y, along.z, c.w, d.x,
                    uint[3](0u, 0u, 0u));
}

// The floats are in the same order as in the struct.
Beam beamFromTexels(vec4 t[6]) {
  return Beam(vec3[3](t[0].xyz, vec3(t[0].w, t[1].xy), vec3(t[1].zw, t[2].x)),
              vec3[3](t[2].yzw, t[3].xyz, vec3(t[3].w, t[4].xy)), vec3(t[4].zw, t[5].x), t[5].yzw);
}
