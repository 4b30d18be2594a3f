// Shapes with exact smooth normals, centred on the origin, outward and counter-clockwise. Flat facets have
// vertices of their own with the facet's normal. All but plane and water are closed. Lengths in metres.
#pragma once

#include "geometry/mesh.h"

namespace nephroid {

// How finely a shape is cut: by the number of edges once round it (along its longest side where it is flat),
// or by the number of vertices it comes closest to. 0: not given; both 0: the shape's own.
struct Density {
  uint32_t segments = 0;
  uint32_t vertices = 0;
};

// An icosahedron's faces cut evenly and blown up: 10 f^2 + 2 vertices, all triangles nearly alike, no poles.
Mesh makeSphere(float radius, Density density = {});

// Axis y. `radius` to the centre of the tube.
Mesh makeTorus(float radius, float tube, Density density = {});

// A tube around a curve that goes p times round the axis y and q times round the circle `radius` about it, at
// a distance of radius/2 from it. p and q have no common divisor.
Mesh makeTorusKnot(uint32_t p, uint32_t q, float radius, float tube, Density density = {});

Mesh makeBox(vec3 size, Density density = {});

// Equilateral triangle with its corners at `radius`, one of them up (+y); axis z.
Mesh makePrism(float radius, float length, Density density = {});

// Axis y.
Mesh makeCylinder(float radius, float height, Density density = {});

// A hollow cylinder, axis y: `radius` is that of its inner wall.
Mesh makeRing(float radius, float height, float thickness, Density density = {});

// Size along x and z, faces +y; two triangles where no density is asked for.
Mesh makePlane(vec2 size, Density density = {});

// Newell's teapot, its longest side (handle to spout) `size`. Three closed surfaces: the body with its lid
// (their gap closed by a flat strip), the handle and the spout, whose open ends are closed by flat caps. As
// in the original, the ends of the handle and of the spout stand a little inside the body.
Mesh makeTeapot(float size, Density density = {});

}  // namespace nephroid
