#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/frame_data.h"

layout(push_constant, scalar) uniform Constants { ShadowConstants constants; };

void main() {
  const SceneVertex vertex = constants.vertices.vertex[gl_VertexIndex];
  const SceneObject object = constants.objects.object[constants.object];
  gl_Position = constants.worldToMap * vec4(worldPoint(object, vertex.position), 1);
}
