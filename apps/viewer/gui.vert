// Triangles of the panels.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "gui_data.h"

layout(push_constant, scalar) uniform Constants {
  GuiConstants constants;
};

layout(location = 0) out vec2 texcoord;
layout(location = 1) out vec4 color;

void main() {
  const GuiVertex vertex = constants.vertices.v[gl_VertexIndex];
  texcoord = vertex.texcoord;
  color = unpackUnorm4x8(vertex.color);
  gl_Position = vec4(constants.scale * vertex.position - 1.0, 0, 1);
}
