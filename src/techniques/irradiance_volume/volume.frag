// Adds the light of one light sample of one volume to the receiver points in its region.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/irradiance_volume/shader_data.h"

struct VolumeView {
  uvec3 size;
  VolumeWords words;
};
uint volumeWord(VolumeView volume, uint index) {
  return volume.words.word[index];
}

uniform sampler2D flowMoves;  // a row for each y and z
struct FlowView {
  vec3 origin;
  vec3 scale;
  uint side;
};
vec3 flowMove(FlowView flow, uvec3 node) {
  return texelFetch(flowMoves, ivec2(node.x, node.z * flow.side + node.y), 0).xyz;
}

#include "irradiance_volume/lookup.h"

layout(constant_id = 0) const uint kRepresentation = 0;
layout(constant_id = 1) const bool kFlows = true;
layout(constant_id = 2) const bool kIsTinted = true;
layout(constant_id = 3) const bool kIsNear = true;  // the lamp
layout(push_constant, scalar) uniform Constants {
  VolumeConstants constants;
};
layout(rgba32f) uniform readonly image2D receiverPosition;
layout(rgba32f) uniform readonly image2D receiverNormal;
uniform sampler2DArray cellVectors;  // as CellImages
uniform sampler2DArray cellTints;
layout(location = 0) out vec4 causticsLux;  // added to that of other shares

// The images hold the cells that come after `first` others.
VolumeLight gridLight(VolumeView volume, uint first, vec3 place) {
  VolumeLight light = noLight();
  const vec3 end = vec3(volume.size);
  if (!isBetween(place, end)) return light;
  const float layer = clamp(place.z - 0.5, 0, end.z - 1);
  const vec3 low = vec3(place.xy / end.xy, floor(layer)), high = vec3(low.xy, low.z + 1);
  const float part = layer - low.z;
  const vec4 vector = mix(textureLod(cellVectors, low, 0), textureLod(cellVectors, high, 0), part);
  light.vector = vector.xyz;
  light.color = vec3(1);
  if (kIsTinted) {
    const vec2 tint = mix(textureLod(cellTints, low, 0).rg, textureLod(cellTints, high, 0).rg, part);
    light.color = vec3(tint.x, vector.w - tint.x - tint.y, tint.y);
  }
  return light;
}

float handedness() {
  return (constants.sizeAndFlowSide & kIsMirrored) != 0 ? -1 : 1;
}

vec3 placeOf(vec3 point) {
  return handedness() * turned(point, constants.turn) + constants.origin;
}

vec3 toWorld(vec3 vector) {
  const vec4 turn = constants.turn;
  const float placesPerMeter = dot(turn, turn);
  return handedness() / placesPerMeter * turned(vector, vec4(-turn.xyz, turn.w));
}

void main() {
  causticsLux = vec4(0);
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const vec4 point = imageLoad(receiverPosition, pixel);
  if (point.w == 0) return;
  const vec3 offset = point.xyz - constants.center;
  const float scale = kIsNear ? nearScale(offset, constants.nearness) : 1;
  const vec3 there = scale * constants.inverseRadius * offset;
  const vec4 inRegion = placeInRegion(there, constants.source);
  if (scale == 0 || inRegion.w == 0) return;
  const vec3 place = placeOf(constants.center + inRegion.xyz / constants.inverseRadius);
  const FlowView flow =
      FlowView(constants.flowOrigin, constants.flowScale, (constants.sizeAndFlowSide & ~kIsMirrored) >> 16u);
  const uint lower = 0xffffu;
  const uvec3 size =
      uvec3(constants.sizeAcross & lower, constants.sizeAcross >> 16u, constants.sizeAndFlowSide & lower);
  VolumeView volume = VolumeView(size, constants.words);
  VolumeLight light = kFlows ? flowedLight(volume, kRepresentation, flow, place)
                             : volumeLight(volume, kRepresentation, place);
  if (light.vector == vec3(0)) return;
  light.vector = toWorld(light.vector);
  if (inRegion.w < 1)
    light.vector = spreadOn(light.vector, normalize(inRegion.xyz), normalize(there - constants.source));
  if (kIsNear) light.vector = nearVector(light.vector, offset, constants.nearness);
  const vec3 normal = imageLoad(receiverNormal, pixel).xyz;
  causticsLux = vec4(inRegion.w * constants.lux * surfaceIlluminance(light, normal), 0);
}
