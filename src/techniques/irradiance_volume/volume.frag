// Adds the light of one light sample of one volume to the receiver points in its region.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/irradiance_volume/shader_data.h"

struct VolumeView {
  uvec3 size;
  VolumeWords words;
};
uint volumeWord(VolumeView volume, uint index) { return volume.words.word[index]; }
struct FlowView {
  vec3 origin;
  vec3 scale;
  uint side;
  FlowWords words;
};
vec3 flowMove(FlowView flow, uint index) { return flow.words.originScaleAndMoves[index + 2]; }
#include "irradiance_volume/lookup.h"

layout(constant_id = 0) const uint kRepresentation = 0;
layout(push_constant, scalar) uniform Constants { VolumeConstants constants; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D receiverPosition;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D receiverNormal;
layout(location = 0) out vec4 causticsLux;  // added to that of other shares

vec3 mapped(vec4 p) {
  return vec3(dot(constants.toPlaces[0], p), dot(constants.toPlaces[1], p), dot(constants.toPlaces[2], p));
}

void main() {
  causticsLux = vec4(0);
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const vec4 point = imageLoad(receiverPosition, pixel);
  if (point.w == 0) return;
  const vec4 inRegion =
      placeInRegion((point.xyz - constants.centre) * constants.inverseRadius, constants.source);
  if (inRegion.w == 0) return;
  const vec3 place = mapped(vec4(constants.centre + inRegion.xyz / constants.inverseRadius, 1));
  FlowView flow = FlowView(constants.flow.originScaleAndMoves[0], constants.flow.originScaleAndMoves[1],
                           constants.flowSide, constants.flow);
  VolumeView volume = VolumeView(constants.size, constants.words);
  const VolumeLight light = flowedLight(volume, kRepresentation, flow, place);
  if (light.vector == vec3(0)) return;
  const vec3 normal = normalize(mapped(vec4(imageLoad(receiverNormal, pixel).xyz, 0)));
  causticsLux = vec4(inRegion.w * constants.lux * surfaceIlluminance(light, normal), 0);
}
