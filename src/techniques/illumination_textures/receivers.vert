// The receivers as the light's virtual camera sees them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/illumination_textures/shader_data.h"

layout(push_constant, scalar) uniform Constants { ViewConstants constants; };
layout(location = 0) out vec3 normal;

void main() {
  const SceneVertex vertex = constants.vertices.vertex[gl_VertexIndex];
  const SceneObject object = constants.objects.object[constants.object];
  const PlaneSet set = constants.set;
  const vec3 position = worldPoint(object, vertex.position);
  normal = worldVector(object, vertex.normal);
  const float depth = dot(position, set.axisW);
  const vec2 place = windowTexel(set, constants.window, position) / float(set.textureSize);
  gl_Position = vec4(2 * place - 1, (depth - set.nearestDepth) / (set.farthestDepth - set.nearestDepth), 1);
}
