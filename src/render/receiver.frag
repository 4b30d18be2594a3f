// The nearest diffuse surface behind a pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/frame_data.h"

layout(constant_id = 0) const bool kHasTexture = false;
layout(push_constant, scalar) uniform Constants {
  SurfaceConstants constants;
};
uniform sampler2D colorTexture;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texcoord;
layout(location = 0) out vec4 receiverPosition;  // a = 1
layout(location = 1) out vec4 receiverNormal;    // on the side of the viewer
layout(location = 2) out vec4 receiverAlbedo;    // a = material + 1

void main() {
  receiverPosition = vec4(position, 1);
  receiverNormal = vec4(normalize(gl_FrontFacing ? normal : -normal), 0);
  receiverAlbedo = vec4(constants.color, constants.material + 1);
  if (kHasTexture) receiverAlbedo.rgb *= texture(colorTexture, texcoord).rgb;
}
