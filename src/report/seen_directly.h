// What of a picture shows no glass and no mirror.
#pragma once

#include <vector>

#include "trace/ray_scene.h"

namespace nephroid {

// For each of the camera's pixels, row by row, 1 where neither its middle nor its corners see a caster first,
// else 0. What glass and mirrors look like has no part in these.
std::vector<uint8_t> seesReceiver(const Scene& scene, const RayScene& rays, uvec2 size);

}  // namespace nephroid
