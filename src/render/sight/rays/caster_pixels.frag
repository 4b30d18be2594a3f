// Where rays met a caster: its depth, and nothing to be lit behind it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

uniform texture2D sightRest;  // a = depth of a caster, 0 where there is none
layout(location = 0) out vec4 receiverPosition;
layout(location = 1) out vec4 receiverAlbedo;

void main() {
  const float depth = texelFetch(sightRest, ivec2(gl_FragCoord.xy), 0).a;
  if (depth == 0) discard;
  gl_FragDepth = depth;
  receiverPosition = receiverAlbedo = vec4(0);
}
