// Makes meshes finer or coarser.
#pragma once

#include <string>

#include "geometry/mesh.h"

namespace nephroid {

// Returns the mesh with `vertices` vertices. Where the mesh has more, edges are collapsed to one of their
// ends, beginning with those that move the surface least (Garland and Heckbert 1997). A closed mesh stays
// closed; vertices at the same position are joined, and normals are averaged anew. The result has more
// vertices than asked where the topology allows no fewer. Where the mesh has fewer, its longest edges are
// halved, which leaves the surface as it is. Throws InputError, beginning with `where`, where edges have to
// be collapsed but an edge has more than two faces or neighboring faces have opposite winding.
Mesh withVertices(const Mesh& mesh, uint32_t vertices, const std::string& where);

}  // namespace nephroid
