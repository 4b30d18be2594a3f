// Skies: light from all directions.
#pragma once

#include "scene/scene.h"

namespace nephroid {

// A sky of 1 nit in every direction.
SkyMap evenSky();

// The unit vector toward a place of a map; (0, 0) is the upper left corner, (1, 1) the lower right one.
vec3 towardSky(vec2 at);

// The solid angle (sr) of a cell in this row.
float skyCellAngle(const SkyMap& sky, uint32_t row);

// The rotation about +y by an angle in degrees, counterclockwise from above.
mat3 skyTurned(float degrees);

// Splits the map into parts: again and again that one whose light comes from the most different directions,
// where its halves differ least (after Viriyothai and Debevec 2009), until there are `most` (at least two),
// or the mean square of the distance (of unit vectors) of directions from their part's mean is at most
// `spread`. What is far brighter than the rest, as a sun, is in parts of its own. The parts together give the
// same illuminance on a facing surface as the map. There are fewer where the map has fewer cells that shine.
std::vector<SkyPart> skyParts(const SkyMap& sky, uint32_t most, double spread = 0);

}  // namespace nephroid
