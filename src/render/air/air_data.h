// The data of one light for the passes that draw the air, for C++ and GLSL.
#ifndef NEPHROID_RENDER_AIR_AIR_DATA_H
#define NEPHROID_RENDER_AIR_AIR_DATA_H

#include "gpu/buffer_address.h"

#include "geometry/box.h"
#include "optics/air.h"

SHARED_BEGIN

// The view ray at the place (x, y) of clip space has the direction middle + x * right + y * down, whose
// component along the camera's axis is 1.
struct AirSight {
  vec3 eye;  // m
  vec3 middle;
  vec3 right;
  vec3 down;
  float nearest;  // m; divided by the depth image's value it is the depth along the camera's axis
  float pace;   // 1/m; for light from afar, planes are distributed like the light that is left in air of this
                // extinction
  uint stride;  // pixels of the depth image from one ray to the next
};

// The numbers of sampling planes (n of Dobashi 2002) and of sub-sample planes for each (m), on which the
// arriving light is looked up. With a tolerance, m is a power of two, and sub-planes are used only where the
// error would otherwise be larger than this part of the light's peak on the whole ray. With a tolerance of 0
// they are used everywhere.
struct AirPlanes {
  uint planes;
  uint subplanes;
  float tolerance;
};

// The box of air whose density is given in cells, and the images with the density between a light and the
// box's nodes.
struct AirBox {
  vec3 corner;       // m
  vec3 inverseSize;  // 1/m
  float firstLayer;  // of this light's images; the layers of the eye begin at 0
};

struct AirLight {
  Air air;
  AirSight sight;
  AirPlanes planes;
  AirBox box;
};

// Constants of the pass that sums the density between a light, or the eye, and the nodes of the box.
struct AirDepthConstants {
  vec3 source;  // m
  uint firstLayer;
  vec3 corner;  // m
  vec3 size;    // m
};

// The number of nodes along each side of the box, with those on its faces.
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
