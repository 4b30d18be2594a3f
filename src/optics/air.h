// The air between objects: how dense it is, and how much of it light crosses. Once for C++ and GLSL.
#ifndef NEPHROID_OPTICS_AIR_H
#define NEPHROID_OPTICS_AIR_H

#include "core/shared_language.h"

SHARED_BEGIN

// Fog lies up to a height and thins out above it, by the factor e for each 1 / inverseFogHeight.
struct Air {
  float extinction;        // 1/m, where it is densest
  float albedo;            // scattering over extinction
  float g;                 // of Henyey and Greenstein's phase function
  float fogBase;           // m along +y, up to where it is densest
  float inverseFogHeight;  // 1/m; 0: equally dense everywhere
};

// m: nothing is followed farther through the air.
SHARED_CONSTANT float kFarthestAir = 1e7f;

// At a height (m), as a part of the largest there is.
SHARED_FUNCTION float fogDensity(Air air, float height) {
  return exp(-max(height - air.fogBase, 0.0f) * air.inverseFogHeight);
}

// Integral of fogDensity over the height, from the fog's base.
SHARED_FUNCTION float fogBelow(Air air, float height) {
  float above = height - air.fogBase;
  return above <= 0.0f ? above : (1.0f - exp(-above * air.inverseFogHeight)) / air.inverseFogHeight;
}

// Mean of fogDensity along a straight way between two heights.
SHARED_FUNCTION float meanFogDensity(Air air, float from, float to) {
  if (air.inverseFogHeight <= 0.0f) return 1.0f;
  float rise = to - from;
  // Closer than this a difference of integrals has too few digits left.
  if (abs(rise) * air.inverseFogHeight < 0.02f) return fogDensity(air, 0.5f * (from + to));
  return (fogBelow(air, to) - fogBelow(air, from)) / rise;
}

SHARED_END

#endif
