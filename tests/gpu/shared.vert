// A whole picture in the color that image and constant tell.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(constant_id = 2) const uint kFactor = 1;
uniform texture2D shade;
layout(location = 0) flat out vec4 color;

void main() {
  gl_Position = vec4(vec2[](vec2(-1, -1), vec2(3, -1), vec2(-1, 3))[gl_VertexIndex], 0.5, 1);
  color = kFactor * texelFetch(shade, ivec2(0), 0);
}
