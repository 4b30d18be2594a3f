// A smooth curved surface through the corners of flat triangles.
#ifndef NEPHROID_GEOMETRY_CURVED_TRIANGLE_H
#define NEPHROID_GEOMETRY_CURVED_TRIANGLE_H

#include "core/shared_language.h"

SHARED_BEGIN

// The offset (m) from the point `p` of the flat triangle, with barycentric `weights`, to the curved surface
// that has the given normals at the corners. It is half the mean of the projections on the corners' tangent
// planes (Boubekeur and Alexa 2008, with the weight that is exact to second order on a surface of constant
// curvature).
SHARED_FUNCTION vec3 curvedOffset(vec3 p, vec3 weights, mat3 corners, mat3 normals) {
  vec3 offset = vec3(0.0f);
  for (int i = 0; i < 3; ++i) offset -= (0.5f * weights[i] * dot(p - corners[i], normals[i])) * normals[i];
  return offset;
}

// Barycentric weights of the point of the triangle's plane that is nearest to `p`. Some are negative where
// that point is outside the triangle.
SHARED_FUNCTION vec3 barycentricOf(vec3 p, mat3 corners) {
  vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  float scale = 1.0f / dot(normal, normal);
  float b = dot(cross(p - corners[0], corners[2] - corners[0]), normal) * scale;
  float c = dot(cross(corners[1] - corners[0], p - corners[0]), normal) * scale;
  return vec3(1.0f - b - c, b, c);
}

// The step along a ray's `direction` that changes its height over a plane as much as the vector `rise` does.
// Zero for a ray that is almost parallel to the plane, where the step would be much too long.
SHARED_FUNCTION vec3 alongRayToPlane(vec3 direction, vec3 rise, vec3 planeNormal) {
  float approach = dot(direction, planeNormal);
  if (abs(approach) < 0.05f) return vec3(0.0f);
  return (dot(rise, planeNormal) / approach) * direction;
}

SHARED_END

#endif
