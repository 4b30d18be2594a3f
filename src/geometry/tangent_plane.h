// A step of the search for where a ray meets a surface that an image shows. A texel shows a point and a
// normal, so the surface's tangent plane there; the ray goes on to that plane, the texel next to where it is
// by then shows another one, and so on. One step is exact on a flat surface, whatever the size of a texel.
//
// Two searches are made of such steps. That of sight (render/sight/find_receiver.glsl.h) asks which of many
// images, if any, shows what a ray sees: it gives up off the image, off the surface, and out of the range
// that it looks in. That of planes (techniques/planes/arrival.glsl.h) has one camera's images and leaves
// light somewhere in any case: it keeps within the planes, and where nothing is seen turns back toward the
// ray's start.
#ifndef NEPHROID_GEOMETRY_TANGENT_PLANE_H
#define NEPHROID_GEOMETRY_TANGENT_PLANE_H

#include "core/shared_language.h"

SHARED_BEGIN

struct TangentPlane {
  vec3 normal;   // of any length but 0
  float offset;  // of a point of it: the point times `normal`
};

SHARED_FUNCTION TangentPlane tangentPlane(vec3 point, vec3 normal) {
  TangentPlane plane;
  plane.normal = normal;
  plane.offset = dot(normal, point);
  return plane;
}

struct PlaneMeeting {
  float distance;  // m along the ray, negative behind its start; not finite for a ray along the plane
  float approach;  // per meter along the ray, in lengths of the normal; negative from behind the plane
};

SHARED_FUNCTION PlaneMeeting meetTangentPlane(vec3 start, vec3 direction, TangentPlane plane) {
  PlaneMeeting meeting;
  meeting.approach = -dot(plane.normal, direction);
  meeting.distance = (dot(plane.normal, start) - plane.offset) / meeting.approach;
  return meeting;
}

SHARED_END

#endif
