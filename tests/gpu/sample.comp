#version 460
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D source;
layout(rgba32f) uniform writeonly image2DArray target;

void main() {
  const ivec2 size = imageSize(target).xy;
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, size))) return;
  imageStore(target, ivec3(texel, 1), textureLod(source, (vec2(texel) + 0.5) / vec2(size), 0));
}
