// Shapes with exact smooth normals, centered at the origin. Triangles are counterclockwise from outside. Flat
// facets have their own vertices with the facet's normal. All shapes but plane and water are closed. Lengths
// are in meters.
#pragma once

#include "geometry/mesh.h"

namespace nephroid {

// How fine a shape is: the number of edges once around it (along its longest side where it is flat), or the
// number of vertices, which is met as closely as possible. 0: not given. Both 0: the shape's default.
struct Density {
  uint32_t segments = 0;
  uint32_t vertices = 0;
};

// An icosahedron whose edges are cut into f equal parts, with all vertices moved onto the sphere: 10 f^2 + 2
// vertices, almost equal triangles, no poles.
Mesh makeSphere(float radius, Density density = {});

// Axis y. `radius`: from the axis to the middle of the tube. `tube`: radius of the tube.
Mesh makeTorus(float radius, float tube, Density density = {});

// A tube around a curve that goes p times around the axis y, and q times around the circle with `radius`
// around that axis, at the distance radius / 2 from the circle. p and q have no common divisor.
Mesh makeTorusKnot(uint32_t p, uint32_t q, float radius, float tube, Density density = {});

Mesh makeBox(vec3 size, Density density = {});

// Equilateral triangle with its corners at `radius`, one of them up (+y); axis z.
Mesh makePrism(float radius, float length, Density density = {});

// Axis y.
Mesh makeCylinder(float radius, float height, Density density = {});

// A hollow cylinder, axis y: `radius` is that of its inner wall.
Mesh makeRing(float radius, float height, float thickness, Density density = {});

// `size`: along x and z. It faces +y. Two triangles where no density is given.
Mesh makePlane(vec2 size, Density density = {});

// Newell's teapot. `size`: its longest side, from handle to spout. It has three closed surfaces: the body
// with its lid (the gap between them is closed by a flat strip), the handle, and the spout; flat caps close
// the open ends of the last two. As in the original, the ends of handle and spout are a little inside the
// body.
Mesh makeTeapot(float size, Density density = {});

}  // namespace nephroid
