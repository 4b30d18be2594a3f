// The normal of the nearest caster in front of the receiver.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 casterNormal;  // on the side of the viewer; a = 1

void main() { casterNormal = vec4(normalize(gl_FrontFacing ? normal : -normal), 1); }
