#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "beams/footprint.h"
#include "scene/scene.h"

namespace nephroid {

// The grid of a sensor's texels, which light passes against the sensor's normal.
PlaneGrid gridOf(const Sensor& sensor);

// lm that the beams leave in every texel of the grid, rows first, added up in double precision. Exact in
// total whatever the beams' sizes; the sum does not depend on the number of threads.
std::vector<glm::dvec3> depositFlux(std::span<const Beam> beams, const PlaneGrid& grid, uvec2 resolution);

}  // namespace nephroid
