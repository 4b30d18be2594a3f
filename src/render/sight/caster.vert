// A caster's surface, with where sight goes that meets it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/sight/sight_data.h"

layout(push_constant, scalar) uniform Constants {
  CasterConstants constants;
};
layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 exit;       // a = reach
layout(location = 3) out vec4 direction;  // a = reflectedReach
layout(location = 4) out vec3 transmittance;
layout(location = 5) out vec3 receiverNormal;
layout(location = 6) out vec4 receiverColor;  // a = 1 where all corners know theirs
layout(location = 7) flat out uint receiverMaterial;

void main() {
  const SightVertex vertex = constants.vertices.vertex[gl_VertexIndex];
  position = vertex.position;
  normal = vertex.normal;
  exit = vec4(vertex.exit, vertex.reach);
  direction = vec4(vertex.direction, vertex.reflectedReach);
  transmittance = vertex.transmittance;
  receiverNormal = vertex.receiverNormal;
  receiverColor = vec4(vertex.receiverColor, vertex.isReceiverKnown);
  receiverMaterial = vertex.receiverMaterial;
  gl_Position = constants.camera.worldToClip * vec4(vertex.position, 1);
}
