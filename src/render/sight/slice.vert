// The receivers as a frame of sight sees them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/sight/sight_data.h"

layout(push_constant, scalar) uniform Constants { SliceConstants constants; };
layout(location = 0) out vec3 normal;
layout(location = 1) out vec2 texcoord;
layout(location = 2) out float depth;  // m along axisW

void main() {
  const SceneVertex vertex = constants.vertices.vertex[gl_VertexIndex];
  const SceneObject object = constants.objects.object[constants.object];
  const SightFrame frame = constants.frame;
  const vec3 fromApex = worldPoint(object, vertex.position) - frame.apex;
  normal = worldVector(object, vertex.normal);
  texcoord = vertex.texcoord;
  depth = dot(fromApex, frame.axisW);
  const float range = constants.farDepth - constants.nearDepth;
  gl_Position = vec4(frame.scale * dot(fromApex, frame.axisU), frame.scale * dot(fromApex, frame.axisV),
                     constants.farDepth * (depth - constants.nearDepth) / range, depth);
}
