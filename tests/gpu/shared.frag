// Adds to what the vertex shader tells, from an image that is its own and one that both have.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(constant_id = 0) const uint kFactor = 1;
uniform texture2D own;
uniform texture2D shade;
layout(location = 0) flat in vec4 color;
layout(location = 0) out vec4 result;

void main() {
  result = color + kFactor * (100 * texelFetch(own, ivec2(0), 0) + 10 * texelFetch(shade, ivec2(0), 0));
}
