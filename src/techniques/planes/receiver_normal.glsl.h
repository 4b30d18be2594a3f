// A receiver's normal in one word, by the octahedral map (Cigolle et al. 2014) of the half sphere that faces
// the light. In the virtual camera's frame: along axisU, along axisV, and against axisW. Zero is a surface
// perpendicular to axisW.

uint packedNormal(vec3 normal) {
  return packSnorm2x16(normal.xy / (abs(normal.x) + abs(normal.y) + normal.z));
}

// Not of unit length.
vec3 unpackedNormal(uint word) {
  const vec2 place = unpackSnorm2x16(word);
  return vec3(place, 1 - abs(place.x) - abs(place.y));
}
