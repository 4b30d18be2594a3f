// How paths move where their lamp's point moves and the place where they meet the caster stays: ray
// differentials (Igehy 1999), with the curvature of the smooth normals.
#pragma once

#include "geometry/curved_triangle.h"
#include "lights/lamp_cells.h"

namespace nephroid {

// For a unit along each of the lamp's axes.
struct PathSpread {
  vec3 direction[2] = {vec3(0), vec3(0)};  // of the way that led to a node
  vec3 position[2] = {vec3(0), vec3(0)};   // m, of the node
  vec3 normal[2] = {vec3(0), vec3(0)};     // of the smooth normal there
};

// Of a path's first node, at the caster, after `length` m along `direction` from the lamp.
PathSpread firstSpread(const LampSpread& lamp, bool isFromAfar, vec3 direction, float length);

// Directions after a boundary from what they were `before`. `normal`: unit, toward the light that comes.
void reflectSpread(const PathSpread& before, vec3 direction, vec3 normal, PathSpread& after);
void refractSpread(const PathSpread& before, vec3 direction, vec3 normal, float eta, PathSpread& after);

// Positions on a surface with the unit normal `normal`, after `length` m along `direction` from the node of
// `before`.
void carrySpread(const PathSpread& before, vec3 direction, float length, vec3 normal, PathSpread& after);

// Normals from positions, in the space of a triangle whose corners and normals these are. `at`: its weights.
void turnNormals(const mat3& corners, const mat3& normals, vec3 at, PathSpread& spread);

}  // namespace nephroid
