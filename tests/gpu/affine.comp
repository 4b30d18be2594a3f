#version 460
#extension GL_GOOGLE_include_directive : require
#include "gpu/buffer_address.h"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar) buffer Values {
  float value[];
};
layout(push_constant, scalar) uniform Constants {
  Values from;
  Values to;
  uint count;
  float factor;
  float offset;
};

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < count) to.value[i] = from.value[i] * factor + offset;
}
