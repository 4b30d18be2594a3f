#version 460
layout(push_constant) uniform Constants {
  vec3 lux;
};
layout(location = 0) out vec4 lit;

void main() {
  lit = vec4(lux, 0);
}
