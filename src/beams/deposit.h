// Counts the flux of beams on the texels of a sensor, on the processor.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "beams/footprint.h"
#include "scene/scene.h"

namespace nephroid {

// The grid of a sensor's texels. Light passes it against the sensor's normal.
PlaneGrid gridOf(const Sensor& sensor);

// The flux (lm) of the beams in each texel of the grid, [row * resolution.x + column], summed in double
// precision. The total is exact for beams of any size, and does not depend on the number of threads.
std::vector<glm::dvec3> depositFlux(std::span<const Beam> beams, const PlaneGrid& grid, uvec2 resolution);

}  // namespace nephroid
