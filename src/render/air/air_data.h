// What the passes that show the air are told of one light, for C++ and GLSL.
#ifndef NEPHROID_RENDER_AIR_AIR_DATA_H
#define NEPHROID_RENDER_AIR_AIR_DATA_H

#include "gpu/buffer_address.h"

#include "geometry/box.h"
#include "optics/air.h"

SHARED_BEGIN

// A ray of sight at the place (x, y) of clip space goes along middle + x * right + y * down, whose part along
// the view is 1.
struct AirSight {
  vec3 eye;  // m
  vec3 middle;
  vec3 right;
  vec3 down;
  float nearest;  // m along the view over the depth image's value
  float pace;     // 1/m: where light comes from afar, planes stand as densely as light is left in such air
  uint stride;    // pixels of the depth image from one ray to the next
};

// Sampling planes (n of Dobashi 2002), each with sub-sample planes (m) on which the light that arrives is
// looked up. With a tolerance m is a power of two, and sub-planes are used where the light changes so much
// that it would be wrong by more than that part of its peak over the whole ray; with none everywhere.
struct AirPlanes {
  uint planes;
  uint subplanes;
  float tolerance;
};

// Where density is given cell by cell: a box, and which images tell how much of it lies before its nodes, as
// seen from a light.
struct AirBox {
  vec3 corner;       // m
  vec3 inverseSize;  // 1/m
  float firstLayer;  // of this light's images; those of the eye begin at 0
};

struct AirLight {
  Air air;
  AirSight sight;
  AirPlanes planes;
  AirBox box;
};

// Sums up the density between a light, or the eye, and the nodes of the box.
struct AirDepthConstants {
  vec3 source;  // m
  uint firstLayer;
  vec3 corner;  // m
  vec3 size;    // m
};

// Along each side of the box, its faces among them.
SHARED_CONSTANT uint kAirNodes = 33u;

SHARED_END

#ifdef __cplusplus
static_assert(sizeof(nephroid::AirLight) == 120);
#else
layout(buffer_reference, scalar) readonly buffer AirLights {
  AirLight light[];
};
#endif

#endif
