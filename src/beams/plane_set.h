// The virtual planes around the receivers of one caster's light (Iwasaki 2005b, sections 3 and 4), once for
// C++ and GLSL.
//
// Planes stand across the mean direction of the light, `axisW`, at equal distances. Each holds a texture of
// illuminance, and all share a virtual camera that looks along axisW. A texture has two windows: an inner one
// about where most of the flux arrives, and an outer one, of a quarter of its texels, about where any does.
#ifndef NEPHROID_BEAMS_PLANE_SET_H
#define NEPHROID_BEAMS_PLANE_SET_H

#include "beams/footprint.h"

SHARED_BEGIN

SHARED_CONSTANT uint kWindows = 2u;
// Units of flux are whole numbers, so that sums do not depend on the order of the beams. All the flux of a
// set is 2^29 units: there is room for what the cosines add where light crosses the planes obliquely.
SHARED_CONSTANT float kUnitsOfAllFlux = 536870912.0f;
// Beams farther than this from the mean direction (as a cosine, 75.5 degrees) run along the planes rather
// than through them.
SHARED_CONSTANT float kLeastPlaneApproach = 0.25f;

// A square of the virtual camera's view, in metres along axisU and axisV.
struct Window {
  vec2 corner;
  float texelsPerMetre;
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
  vec3 luxMetresSquaredPerUnit;  // flux (lm) of one unit of the textures, by channel
  float nearestDepth;            // m along axisW, what the virtual camera sees
  float farthestDepth;
};

SHARED_FUNCTION PlaneGrid planeGrid(PlaneSet set, uint plane, uint window) {
  Window w = set.windows[window];
  PlaneGrid grid;
  grid.corner = w.corner.x * set.axisU + w.corner.y * set.axisV +
                (set.firstDepth + float(plane) * set.depthStep) * set.axisW;
  grid.axisU = w.texelsPerMetre * set.axisU;
  grid.axisV = w.texelsPerMetre * set.axisV;
  grid.normal = set.axisW;
  return grid;
}

// Place in the window, in texels, of a point by its metres along axisU and axisV.
SHARED_FUNCTION vec2 texelOfWindow(Window window, vec2 place) {
  return (place - window.corner) * window.texelsPerMetre;
}

SHARED_FUNCTION vec2 windowTexel(PlaneSet set, uint window, vec3 point) {
  return texelOfWindow(set.windows[window], vec2(dot(point, set.axisU), dot(point, set.axisV)));
}

// A texture has a coarse part beside it, for light that is too dim and too wide to be worth its texels: of
// every window the texels that many times as wide.
SHARED_CONSTANT uint kCoarseness = 8u;

// Images hold, for each channel, a layer for each window of each plane, inner windows first, and then the
// coarse parts: side by side in tiles, of which kCoarseness stand along each side of a layer.
SHARED_FUNCTION uint textureIndex(PlaneSet set, uint plane, uint window) {
  return window * set.planes + plane;
}

SHARED_FUNCTION uint coarseLayer(PlaneSet set, uint index) {
  return kWindows * set.planes + index / (kCoarseness * kCoarseness);
}

// In tiles from the layer's first.
SHARED_FUNCTION vec2 coarseTile(uint index) {
  return vec2(float(index % kCoarseness), float(index / kCoarseness % kCoarseness));
}

SHARED_FUNCTION uint layersOfChannel(PlaneSet set) {
  return coarseLayer(set, kWindows * set.planes - 1u) + 1u;
}

SHARED_END

#endif
