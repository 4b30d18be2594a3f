// The density of the air between objects, and its mean along a line. Written once for C++ and GLSL.
#ifndef NEPHROID_OPTICS_AIR_H
#define NEPHROID_OPTICS_AIR_H

#include "core/shared_language.h"

SHARED_BEGIN

// Fog is equally dense up to a height. Above, its density falls by the factor e every 1 / inverseFogHeight
// meters.
struct Air {
  float extinction;        // 1/m, where it is densest
  float albedo;            // scattering over extinction
  float g;                 // of Henyey and Greenstein's phase function
  float fogBase;           // m along +y, up to where it is densest
  float inverseFogHeight;  // 1/m; 0: equally dense everywhere
};

// m; light is not followed farther through the air.
SHARED_CONSTANT float kFarthestAir = 1e7f;

// The density at a height (m), as a part (0..1) of the largest density.
SHARED_FUNCTION float fogDensity(Air air, float height) {
  return exp(-max(height - air.fogBase, 0.0f) * air.inverseFogHeight);
}

// The integral (m) of fogDensity over the height, from fogBase; negative below it.
SHARED_FUNCTION float fogBelow(Air air, float height) {
  float above = height - air.fogBase;
  return above <= 0.0f ? above : (1.0f - exp(-above * air.inverseFogHeight)) / air.inverseFogHeight;
}

// The mean of fogDensity along a straight line between two heights (m).
SHARED_FUNCTION float meanFogDensity(Air air, float from, float to) {
  if (air.inverseFogHeight <= 0.0f) return 1.0f;
  float rise = to - from;
  // Closer than this a difference of integrals has too few digits left.
  if (abs(rise) * air.inverseFogHeight < 0.02f) return fogDensity(air, 0.5f * (from + to));
  return (fogBelow(air, to) - fogBelow(air, from)) / rise;
}

SHARED_END

#endif
