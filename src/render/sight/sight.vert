// A caster's surface, with where sight goes that meets it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/sight/sight_data.h"

layout(push_constant, scalar) uniform Constants { SightConstants constants; };
layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec3 exit;
layout(location = 3) out vec3 direction;
layout(location = 4) out vec3 transmittance;
invariant gl_Position;

void main() {
  const SightVertex vertex = constants.vertices.vertex[gl_VertexIndex];
  position = vertex.position;
  normal = vertex.normal;
  exit = vertex.exit;
  direction = vertex.direction;
  transmittance = vertex.transmittance;
  gl_Position = constants.camera.worldToClip * vec4(vertex.position, 1);
}
