// Panels, and pictures among them.
#version 460

uniform sampler2D image;

layout(location = 0) in vec2 texcoord;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 seen;

void main() {
  seen = color * texture(image, texcoord);
}
