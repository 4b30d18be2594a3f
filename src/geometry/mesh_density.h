#pragma once

#include <string>

#include "geometry/mesh.h"

namespace nephroid {

// The mesh with so many vertices. Fewer than it has: edges are collapsed at one of their ends, those first
// that move the surface least (Garland and Heckbert 1997), as long as that leaves what is closed closed;
// vertices at one position are joined and normals are averaged anew; where its topology allows no fewer, it
// has more. More than it has: its longest edges are halved, which leaves the surface as it is. Throws
// InputError, beginning with `where`, if there are to be fewer and an edge has more than two faces, or faces
// run against each other.
Mesh withVertices(const Mesh& mesh, uint32_t vertices, const std::string& where);

}  // namespace nephroid
