// One light with its shadow maps, its gobo and its profile.
#include "render/frame_data.h"

layout(constant_id = 0) const uint kEmitterType = kEmitterPoint;
// Maps for each point. 0: nothing can cast a shadow. 1: one map. 6: the faces of a cube around the light: +x,
// -x, +y, -y, +z, -z.
layout(constant_id = 1) const uint kMapCount = 1;
layout(constant_id = 2) const bool kIsLine = false;
layout(constant_id = 5) const bool kHasAir = false;
layout(push_constant, scalar) uniform Constants {
  DirectConstants constants;
};
uniform sampler2DArray shadowMaps;
#include "render/light_shape.glsl.h"

// One of the light's points.
Emitter emitterAt(vec3 origin) {
  return Emitter(origin, kEmitterType, constants.direction, constants.coneScale, constants.power,
                 constants.coneOffset, 0u);
}

// The place of `offset`, a vector from the light, on the cube's face that looks along its largest component.
vec3 projectedOnCube(vec3 offset, out uint face) {
  const vec3 size = abs(offset);
  if (size.x >= size.y && size.x >= size.z) {
    face = offset.x > 0 ? 0u : 1u;
    return vec3(offset.x > 0 ? offset.z : -offset.z, offset.y, size.x);
  }
  if (size.y >= size.z) {
    face = offset.y > 0 ? 2u : 3u;
    return vec3(offset.y > 0 ? -offset.z : offset.z, offset.x, size.y);
  }
  face = offset.z > 0 ? 4u : 5u;
  return vec3(offset.z > 0 ? -offset.x : offset.x, offset.y, size.z);
}

// The place in a map and the depth, before the division by the depth.
vec3 projected(vec3 offset, float texels, out uint face) {
  face = 0;
  if (kMapCount == 1)
    return vec3(dot(constants.mapX, offset), dot(constants.mapY, offset), dot(constants.mapDepth, offset));
  const vec3 place = projectedOnCube(offset, face);
  return vec3(place.xy / (constants.texelSize * texels), place.z);
}

// The place of a map's middle, for one of a light's points.
vec2 middleOfMap(vec3 origin) {
  if (!kIsLine || kMapCount == 0) return vec2(0);
  const vec3 aim = constants.aim - origin;
  return vec2(dot(constants.mapX, aim), dot(constants.mapY, aim)) / dot(constants.mapDepth, aim);
}

// The part (0..1) of the light that arrives at `offset` from the light (for light from afar: from the maps'
// aim), filtered with a tent two texels wide.
float litPart(vec3 offset, vec2 middle, uint firstMap) {
  const bool isPerspective = kEmitterType != kEmitterDirectional;
  const float texels = float(textureSize(shadowMaps, 0).x);
  uint face = 0;
  const vec3 place = projected(offset, texels, face);
  const float inverse = isPerspective ? 1 / place.z : 1;
  const float depth = isPerspective ? constants.depthScale + constants.depthOffset * inverse
                                    : place.z + constants.depthOffset;
  // Outside a map nothing shades, and its border is empty.
  const vec2 at = place.xy * inverse - middle + 0.5;
  const vec4 isLit = step(vec4(min(depth, 1)), textureGather(shadowMaps, vec3(at, float(firstMap + face))));
  const vec2 after = fract(at * texels - 0.5);
  const vec2 columns = mix(isLit.wx, isLit.zy, after.x);
  const float sum = mix(columns.x, columns.y, after.y);
  return isPerspective && place.z <= 0 ? 1 : sum;
}

// The same for this light.
vec3 shape(vec3 direction) {
  return shape(constants.direction, constants.goboTurn, direction);
}
