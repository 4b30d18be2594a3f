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

// Splits the map into `count` parts (at least two) of about the same flux (median cuts, Debevec 2005). Each
// part is a directional light from the mean direction of its cells. The parts together give the same
// illuminance on a facing surface as the map. There are fewer parts where the map has fewer cells that shine.
std::vector<SkyPart> skyParts(const SkyMap& sky, uint32_t count);

}  // namespace nephroid
