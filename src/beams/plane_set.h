// The virtual planes around the receivers of one caster's light (Iwasaki 2005b, sections 3 and 4). Written
// once for C++ and GLSL.
//
// Planes stand across the mean direction of the light, `axisW`, at equal distances. Each holds a texture of
// illuminance, and all share a virtual camera that looks along axisW. A texture has two windows: an inner one
// around the place where most of the flux arrives, and an outer one, with a quarter of the texels, around all
// places where flux arrives.
#ifndef NEPHROID_BEAMS_PLANE_SET_H
#define NEPHROID_BEAMS_PLANE_SET_H

#include "beams/footprint.h"

SHARED_BEGIN

SHARED_CONSTANT uint kWindows = 2u;
// Textures hold flux in whole units, so that sums do not depend on the order of the beams. All the flux of a
// set is 2^29 units. The other bits are for light that crosses the planes obliquely, whose flux is divided by
// the cosine.
SHARED_CONSTANT float kUnitsOfAllFlux = 536870912.0f;
// Beams farther than this from the mean direction (as a cosine, 75.5 degrees) run along the planes rather
// than through them.
SHARED_CONSTANT float kLeastPlaneApproach = 0.25f;

// A square of the virtual camera's view, in meters along axisU and axisV.
struct Window {
  vec2 corner;
  float texelsPerMeter;
  float size;  // texels along a side
};

struct PlaneSet {
  vec3 axisU;        // unit, along a row of texels
  vec3 axisV;        // unit, down the rows
  vec3 axisW;        // unit, mean direction of the light
  float firstDepth;  // m along axisW, of the first plane
  float depthStep;   // m between planes
  uint planes;
  Window windows[2];             // inner, outer
  vec3 luxMetersSquaredPerUnit;  // flux (lm) of one unit of the textures, for each channel
  float nearestDepth;            // m along axisW, the range that the virtual camera sees
  float farthestDepth;
};

SHARED_FUNCTION PlaneGrid planeGrid(PlaneSet set, uint plane, uint window) {
  Window w = set.windows[window];
  PlaneGrid grid;
  grid.corner = w.corner.x * set.axisU + w.corner.y * set.axisV +
                (set.firstDepth + float(plane) * set.depthStep) * set.axisW;
  grid.axisU = w.texelsPerMeter * set.axisU;
  grid.axisV = w.texelsPerMeter * set.axisV;
  grid.normal = set.axisW;
  return grid;
}

// Texel coordinates in the window. `place`: m along axisU and axisV.
SHARED_FUNCTION vec2 texelOfWindow(Window window, vec2 place) {
  return (place - window.corner) * window.texelsPerMeter;
}

SHARED_FUNCTION vec2 windowTexel(PlaneSet set, uint window, vec3 point) {
  return texelOfWindow(set.windows[window], vec2(dot(point, set.axisU), dot(point, set.axisV)));
}

// Each texture has a coarse copy for dim, wide footprints, for which fine texels would cost too much time.
// Its texels are this many times as wide.
SHARED_CONSTANT uint kCoarseness = 8u;

// An image has, for each channel, one layer for each window of each plane, inner windows first. Then follow
// the layers of the coarse copies, each with kCoarseness x kCoarseness copies as tiles.
SHARED_FUNCTION uint textureIndex(PlaneSet set, uint plane, uint window) {
  return window * set.planes + plane;
}

SHARED_FUNCTION uint coarseLayer(PlaneSet set, uint index) {
  return kWindows * set.planes + index / (kCoarseness * kCoarseness);
}

// Column and row of the copy's tile in its layer.
SHARED_FUNCTION vec2 coarseTile(uint index) {
  return vec2(float(index % kCoarseness), float(index / kCoarseness % kCoarseness));
}

SHARED_FUNCTION uint layersOfChannel(PlaneSet set) {
  return coarseLayer(set, kWindows * set.planes - 1u) + 1u;
}

SHARED_END

#endif
