// Light from all around.
#pragma once

#include "scene/scene.h"

namespace nephroid {

// 1 nit everywhere.
SkyMap evenSky();

// Unit vector toward a place of a map, from (0, 0), its upper left corner, to (1, 1).
vec3 towardSky(vec2 at);

// Steradians of a cell of a row.
float skyCellAngle(const SkyMap& sky, uint32_t row);

// By an angle (degrees) about +y, anticlockwise from above.
mat3 skyTurned(float degrees);

// The map in so many parts of about the same flux, each where its light comes from in the mean (median cuts,
// Debevec 2005), at least two. What they send onto a facing surface adds up to what the map sends. Fewer
// where the map has fewer cells that shine.
std::vector<SkyPart> skyParts(const SkyMap& sky, uint32_t count);

}  // namespace nephroid
