// Mends what exporters do to the faces of a mesh: seams a hair wide.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/mesh.h"
#include "geometry/mesh_edges.h"

namespace nephroid {

// Vertices at open edges that are nearer to each other than the rounding of the mesh's coordinates become
// one place; never where its own
// edges are as short as that. `joined` follows. False where nothing moved.
bool closeSeams(Mesh& mesh, const MeshEdges& edges, std::vector<uint32_t>& joined);

}  // namespace nephroid
