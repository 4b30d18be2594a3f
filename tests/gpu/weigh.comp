// Weighted sum of an array's images. Names tell images and constants apart, not the order they stand in.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8) in;
layout(constant_id = 4) const uint kFirstWeight = 1;
layout(constant_id = 7) const uint kSecondWeight = 1;
layout(rgba32f) uniform writeonly image2D sum;
uniform texture2D parts[2];

void main() {
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (texel.x >= imageSize(sum).x) return;
  imageStore(sum, texel,
             kFirstWeight * texelFetch(parts[0], texel, 0) + kSecondWeight * texelFetch(parts[1], texel, 0));
}
