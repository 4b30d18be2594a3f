#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace nephroid {

// For every triangle the number of the smooth surface it belongs to: triangles are joined over vertices with
// the same position and (to about a degree) the same normal. A sphere is one surface, a box six.
std::vector<uint32_t> smoothPatches(const Mesh& mesh);

}  // namespace nephroid
