#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/frame_data.h"

layout(push_constant, scalar) uniform Constants {
  SurfaceConstants constants;
};
layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec2 texcoord;

void main() {
  const SceneVertex vertex = constants.vertices.vertex[gl_VertexIndex];
  const SceneObject object = constants.objects.object[constants.object];
  position = worldPoint(object, vertex.position);
  normal = worldVector(object, vertex.normal);
  texcoord = vertex.texcoord;
  gl_Position = constants.worldToClip * vec4(position, 1);
}
