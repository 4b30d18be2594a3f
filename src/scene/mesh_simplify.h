#pragma once

#include <string>

#include "scene/scene.h"

namespace nephroid {

// A mesh of `vertices` vertices: edges are collapsed at one of their ends, those first that move the surface
// least (Garland and Heckbert 1997), as long as that leaves what is closed closed. Vertices at one position
// are joined and normals are averaged anew. A mesh that has no more comes back as it is; where its topology
// allows no fewer, it has more. Throws InputError, beginning with `where`, if an edge has more than two
// faces, or faces run against each other.
Mesh simplified(const Mesh& mesh, uint32_t vertices, const std::string& where);

}  // namespace nephroid
