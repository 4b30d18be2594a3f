// Bounds of a group of beams: a hull that widens along an axis of the world (Barczak and Olano, 3.3). It
// tells where the rays cross one plane, and how steep they are at most. Written once for C++ and GLSL.
#ifndef NEPHROID_BEAMS_BEAM_BOUNDS_H
#define NEPHROID_BEAMS_BEAM_BOUNDS_H

#include "core/shared_language.h"

SHARED_BEGIN

// The main direction of the light: +x, -x, +y, -y, +z or -z. Groups of kEveryWay go in all directions and
// have no hull.
SHARED_CONSTANT uint kWays = 6u;
SHARED_CONSTANT uint kEveryWay = 6u;
SHARED_CONSTANT uint kChildren = 8u;

// Bits of BeamBounds::kind: the main direction, then whether it is a single beam, then the portion of that
// beam.
SHARED_CONSTANT uint kWayMask = 7u;
SHARED_CONSTANT uint kIsBeam = 8u;
SHARED_CONSTANT uint kPortionShift = 4u;

struct BeamBounds {
  vec2 crossingLow;  // m, two coordinates across the main direction where rays cross the reference plane
  vec2 crossingHigh;
  vec2 slopeLow;  // m across per m along
  vec2 slopeHigh;
  float reference;  // m along the main direction, of the reference plane
  float nearest;    // m along the main direction, where the first ray begins
  float farthest;   // m along the main direction; no light gets farther
  uint first;       // index of the first of its kChildren children, or of its beam
  uint kind;
  uint unused[3];  // fills the struct up to four texels
};

// A vector's two components across the main direction and, as z, the one along it.
SHARED_FUNCTION vec3 inWay(vec3 v, uint way) {
  vec3 turned = way < 2u ? vec3(v.y, v.z, v.x) : way < 4u ? vec3(v.z, v.x, v.y) : v;
  if ((way & 1u) != 0u) turned.z = -turned.z;
  return turned;
}

// Whether light of the group may reach a box (m).
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
