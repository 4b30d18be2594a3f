// The part of a receiver, a square on its tangent plane, that a pixel shows.
struct ReceiverSquare {
  vec3 point;   // m, its middle
  vec3 normal;  // unit; zero where there is no receiver
  vec3 axisU;   // pixels per meter, on the tangent plane
  vec3 axisV;
  float inverseArea;  // 1/m^2; negative where the axes are left-handed about the normal
};

vec4 axisUTexel(ReceiverSquare square) {
  return vec4(square.axisU, square.inverseArea);
}

vec4 axisVTexel(ReceiverSquare square, float patchId) {
  return vec4(square.axisV, patchId);
}

ReceiverSquare squareFromTexels(vec3 point, vec4 u, vec4 v) {
  const vec3 normal = cross(u.xyz, v.xyz);
  return ReceiverSquare(point, u.w == 0 ? vec3(0) : normal / u.w, u.xyz, v.xyz, u.w);
}
