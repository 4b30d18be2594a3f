// The emitters that stand for lights where light is sampled: a point, a point with a cone, a direction, or a
// point of a panel. Lines, panels and skies are represented by several emitters.
#ifndef NEPHROID_LIGHTS_EMITTER_H
#define NEPHROID_LIGHTS_EMITTER_H

#include "core/shared_language.h"

SHARED_BEGIN

SHARED_CONSTANT uint kEmitterDirectional = 0u;
SHARED_CONSTANT uint kEmitterPoint = 1u;
SHARED_CONSTANT uint kEmitterSpot = 2u;
// Its intensity falls with the cosine of the angle from its normal.
SHARED_CONSTANT uint kEmitterPanel = 3u;

struct Emitter {
  vec3 position;    // m; without meaning for a directional light
  uint type;        // kEmitter...
  vec3 direction;   // unit, in which the light travels (directional, spot); the normal of a panel
  float coneScale;  // of coneFalloff
  vec3 power;       // cd at its peak, or lux on a facing surface (directional)
  float coneOffset;
  uint light;  // index of the scene's light that it stands for; a gobo or profile of that light is not
               // included here
};

// The unit vector along which the light travels at `point` (m).
SHARED_FUNCTION vec3 emitterDirection(Emitter emitter, vec3 point) {
  if (emitter.type == kEmitterDirectional) return emitter.direction;
  return normalize(point - emitter.position);
}

// Falloff of KHR_lights_punctual at an angle from the spot's axis.
SHARED_FUNCTION float coneFalloff(float cosine, float coneScale, float coneOffset) {
  float linear = clamp(cosine * coneScale + coneOffset, 0.0f, 1.0f);
  return linear * linear;
}

// Luminous intensity (cd) toward the unit vector `direction`; lux for a directional light.
SHARED_FUNCTION vec3 emitterPower(Emitter emitter, vec3 direction) {
  if (emitter.type == kEmitterPanel) return emitter.power * max(dot(emitter.direction, direction), 0.0f);
  if (emitter.type != kEmitterSpot) return emitter.power;
  return emitter.power *
         coneFalloff(dot(emitter.direction, direction), emitter.coneScale, emitter.coneOffset);
}

// Illuminance (lux) at `point` on a surface facing the light.
SHARED_FUNCTION vec3 emitterIlluminance(Emitter emitter, vec3 point) {
  if (emitter.type == kEmitterDirectional) return emitter.power;
  vec3 offset = point - emitter.position;
  float distanceSquared = dot(offset, offset);
  return emitterPower(emitter, offset / sqrt(distanceSquared)) / distanceSquared;
}

SHARED_END

#endif
