#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/buffer_address.h"
#include "transport/table/entry.h"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar) readonly buffer Words {
  uint word[];
};
layout(buffer_reference, scalar) readonly buffer Layouts {
  TableLayout table[];
};
layout(buffer_reference, scalar) readonly buffer Directions {
  vec3 direction[];
};

#define TableView TableLayout
Words tableWords;
uint tableWord(TableView table, uint index) {
  return tableWords.word[index];
}
#include "transport/table/lookup.h"

layout(buffer_reference, scalar) writeonly buffer Rays {
  OutgoingRay ray[];
};
layout(push_constant, scalar) uniform Constants {
  Words words;
  Layouts layouts;
  Directions directions;
  Rays rays;
  uint count;
};

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  tableWords = words;
  const TableLayout table = layouts.table[0];
  const vec3 direction = directions.direction[i];
  rays.ray[i] = lookUpRay(table, i % table.bands, i % table.vertices, direction);
}
