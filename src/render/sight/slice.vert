// The receivers as a frame of sight sees them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/sight/sight_data.h"

layout(push_constant, scalar) uniform Constants {
  SliceConstants constants;
};
layout(location = 0) out vec3 normal;
layout(location = 1) out vec2 texcoord;

void main() {
  const SceneVertex vertex = constants.vertices.vertex[gl_VertexIndex];
  const SceneObject object = constants.objects.object[constants.object];
  const SightFrame frame = constants.frame;
  const vec3 fromApex = worldPoint(object, vertex.position) - frame.apex;
  normal = worldVector(object, vertex.normal);
  texcoord = vertex.texcoord;
  const float depth = dot(fromApex, frame.axisW);
  const vec2 depths = constants.depths;
  const vec2 place = frame.scale * vec2(dot(fromApex, frame.axisU), dot(fromApex, frame.axisV));
  gl_Position = vec4(constants.part * (place + depth) - depth,
                     depths.x * (depths.y - depth) / (depths.y - depths.x), depth);
}
