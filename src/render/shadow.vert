#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/frame_data.h"

layout(push_constant, scalar) uniform Constants {
  ShadowConstants constants;
};

void main() {
  const SceneVertex vertex = constants.vertices.vertex[gl_VertexIndex];
  gl_Position = constants.objectToMap * vec4(vertex.position, 1);
}
