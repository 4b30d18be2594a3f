// Groups the triangles of a mesh into smooth surfaces.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace nephroid {

// For every triangle, the number of the smooth surface that it belongs to. Triangles belong together where
// they share a vertex with the same position and, to about a degree, the same normal. A sphere is one
// surface; a box is six.
std::vector<uint32_t> smoothPatches(const Mesh& mesh);

}  // namespace nephroid
