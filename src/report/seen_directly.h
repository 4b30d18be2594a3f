// Finds the pixels of a picture that show no glass and no mirror.
#pragma once

#include <vector>

#include "trace/ray_scene.h"

namespace nephroid {

// For each pixel of the camera, row by row: 1 where the nearest surface at its middle and its corners is no
// caster, else 0. The view through glass and mirrors does not influence these pixels.
std::vector<uint8_t> seesReceiver(const Scene& scene, const RayScene& rays, uvec2 size);

}  // namespace nephroid
