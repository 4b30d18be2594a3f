// The receivers as the light's virtual camera sees them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/planes/shader_data.h"

layout(push_constant, scalar) uniform Constants {
  ViewConstants constants;
};
layout(location = 0) out vec3 normal;  // in the camera's frame, as receiver_normal.glsl.h packs it

void main() {
  const SceneVertex vertex = constants.vertices.vertex[gl_VertexIndex];
  const SceneObject object = constants.objects.object[constants.object];
  const vec4 position = vec4(worldPoint(object, vertex.position), 1);
  normal = worldVector(object, vertex.normal) * mat3(constants.axisU, constants.axisV, -constants.axisW);
  gl_Position = vec4(dot(constants.toClip[0], position), dot(constants.toClip[1], position),
                     dot(constants.toClip[2], position), 1);
}
