// Has an image of the name that gpu_test_shared.vert gives another kind of image.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
uniform texture2DArray shade;
layout(location = 0) flat in vec4 color;
layout(location = 0) out vec4 result;

void main() {
  result = color + texelFetch(shade, ivec3(0), 0);
}
