// Smooth normals over hard edges, as a modeler leaves them that joins all vertices of a machine part: there
// the surface is divided into the smooth parts that it has.
#pragma once

#include "geometry/mesh.h"

namespace nephroid {

inline constexpr float kCreaseAngle = 58;  // degrees between the normals of the faces at an edge

// Gives the faces on either side of a crease normals of their own, the mean of the faces around the vertex on
// that side by their angles there (Thuermer and Wuethrich 1998). Only vertices are changed whose normal is
// common to faces that are parted all around by creases. Returns the number of vertices that were added. The
// mesh has normals, and no triangle without an area.
uint32_t splitAtCreases(Mesh& mesh);

}  // namespace nephroid
