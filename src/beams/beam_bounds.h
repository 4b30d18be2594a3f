// Bounds of a bundle of beams as a hull that widens along an axis of the world (Barczak and Olano, 3.3):
// where its rays cross one plane, and how steeply they may go from there. Once for C++ and GLSL.
#ifndef NEPHROID_BEAMS_BEAM_BOUNDS_H
#define NEPHROID_BEAMS_BEAM_BOUNDS_H

#include "core/shared_language.h"

SHARED_BEGIN

// Ways along which light mainly goes: +x, -x, +y, -y, +z, -z; rays of kEveryWay have no hull.
SHARED_CONSTANT uint kWays = 6u;
SHARED_CONSTANT uint kEveryWay = 6u;
SHARED_CONSTANT uint kChildren = 8u;

// What is bounded: the way in the low bits, whether it is one beam, and above these the beam's portion.
SHARED_CONSTANT uint kWayMask = 7u;
SHARED_CONSTANT uint kIsBeam = 8u;
SHARED_CONSTANT uint kPortionShift = 4u;

struct BeamBounds {
  vec2 crossingLow;  // m, across the way, where rays cross the reference plane
  vec2 crossingHigh;
  vec2 slopeLow;  // m across per m along
  vec2 slopeHigh;
  float reference;  // m along the way, of the plane
  float nearest;    // m along the way, where the first ray begins
  float farthest;   // m along the way, past which no light comes
  uint first;       // of kChildren bounds of its parts; or its beam
  uint kind;
  uint unused[3];  // up to four texels
};

// Across the way and, as z, along it.
SHARED_FUNCTION vec3 inWay(vec3 v, uint way) {
  vec3 turned = way < 2u ? vec3(v.y, v.z, v.x) : way < 4u ? vec3(v.z, v.x, v.y) : v;
  if ((way & 1u) != 0u) turned.z = -turned.z;
  return turned;
}

// Whether the bundle may have light in a box.
SHARED_FUNCTION bool boundsMeetBox(BeamBounds bounds, vec3 low, vec3 high) {
  uint way = bounds.kind & kWayMask;
  if (way == kEveryWay) return true;
  vec3 a = inWay(low, way);
  vec3 b = inWay(high, way);
  vec3 lower = min(a, b);
  vec3 upper = max(a, b);
  float from = max(lower.z, bounds.nearest);
  float to = min(upper.z, bounds.farthest);
  float begin = from - bounds.reference;
  float end = to - bounds.reference;
  vec2 lowest = min(min(bounds.slopeLow * begin, bounds.slopeLow * end),
                    min(bounds.slopeHigh * begin, bounds.slopeHigh * end));
  vec2 highest = max(max(bounds.slopeLow * begin, bounds.slopeLow * end),
                     max(bounds.slopeHigh * begin, bounds.slopeHigh * end));
  vec2 first = bounds.crossingLow + lowest;
  vec2 last = bounds.crossingHigh + highest;
  return from <= to && last.x >= lower.x && last.y >= lower.y && first.x <= upper.x && first.y <= upper.y;
}

SHARED_END

#endif
