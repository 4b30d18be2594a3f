// The light of beams within a medium, stored in layers across the light: from it follows what the medium
// scatters. The grid of layers is written once for C++ and GLSL.
//
// Between two layers light is interpolated along the mean direction of the beams, which is `drift`.
#ifndef NEPHROID_BEAMS_LIGHT_LAYERS_H
#define NEPHROID_BEAMS_LIGHT_LAYERS_H

#include "beams/beam.h"

SHARED_BEGIN

struct LayerGrid {
  vec3 corner;  // m, where texel (0, 0) of layer 0 begins
  vec3 axisU;   // unit, along a row of texels
  vec3 axisV;   // unit, down the rows
  vec3 axisW;   // unit, from layer to layer
  vec2 drift;   // m along axisU and axisV per m along axisW
  float texelsPerMeter;
  float layersPerMeter;
  vec2 size;  // texels
  float layers;
};

// The place of a point (m) in the grid: texels along a row, texels down the rows, and layers.
SHARED_FUNCTION vec3 placeInLayers(LayerGrid grid, vec3 point) {
  vec3 offset = point - grid.corner;
  float depth = dot(offset, grid.axisW);
  vec2 across = vec2(dot(offset, grid.axisU), dot(offset, grid.axisV)) - depth * grid.drift;
  return vec3(grid.texelsPerMeter * across, grid.layersPerMeter * depth);
}

SHARED_END

#ifdef __cplusplus

#include <span>
#include <vector>

namespace nephroid {

struct LayerSettings {
  uint32_t layers = 24;   // two or more
  uint32_t texels = 128;  // along a layer's longer side
  float farthest = 1e7f;  // m; light is not followed farther through the medium
  float relief = 0;       // m along the axis, the height of waves on the surface of the medium
};

struct LightLayers {
  LayerGrid grid{};
  // [(layer * rows + row) * columns + column]. x: the fluence rate (lux, mean of the channels, without
  // absorption by the medium). y, z, w: this value times the light's slopes along axisU and axisV (m per m
  // along axisW), and times the length (m) of its way through the medium.
  std::vector<vec4> texels;
  vec3 color{1};  // of all the light, divided by the mean of its channels
};

// Takes the light that goes within 78 degrees of `axis` (unit); the layers stand across the axis. Without
// such light the result has no texels. So that no light is missing near surfaces, a beam begins before its
// start by the relief and one layer, and ends one layer behind the surface that it meets. Each layer that a
// beam crosses within the grid holds all its flux.
LightLayers lightInLayers(std::span<const Beam> beams, vec3 axis, const LayerSettings& settings);

}  // namespace nephroid

#endif

#endif
