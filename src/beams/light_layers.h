// The light of beams in the volume that they cross, in layers one behind the other: what a medium there has
// to scatter. The grid of layers once for C++ and GLSL.
//
// Between layers light is where it is on the way most of it goes from one to the next: `drift`.
#ifndef NEPHROID_BEAMS_LIGHT_LAYERS_H
#define NEPHROID_BEAMS_LIGHT_LAYERS_H

#include "beams/beam.h"

SHARED_BEGIN

struct LayerGrid {
  vec3 corner;  // m, where texel (0, 0) of layer 0 begins
  vec3 axisU;   // unit, along a row of texels
  vec3 axisV;   // unit, down the rows
  vec3 axisW;   // unit, from layer to layer
  vec2 drift;   // m along axisU and axisV for each along axisW
  float texelsPerMetre;
  float layersPerMetre;
  vec2 size;  // texels
  float layers;
};

// Texels along a row and down the rows, and layers, of a point.
SHARED_FUNCTION vec3 placeInLayers(LayerGrid grid, vec3 point) {
  vec3 offset = point - grid.corner;
  float depth = dot(offset, grid.axisW);
  vec2 across = vec2(dot(offset, grid.axisU), dot(offset, grid.axisV)) - depth * grid.drift;
  return vec3(grid.texelsPerMetre * across, grid.layersPerMetre * depth);
}

SHARED_END

#ifdef __cplusplus

#include <span>
#include <vector>

namespace nephroid {

struct LayerSettings {
  uint32_t layers = 24;   // two or more
  uint32_t texels = 128;  // along a layer's longer side
  float farthest = 1e7f;  // m: light is not followed farther through the medium
  float relief = 0;       // m along the axis, of the surface at which the medium begins
};

struct LightLayers {
  LayerGrid grid{};
  // Rows of each layer, layers one after the other: fluence rate (lux, mean of the channels, as it is where
  // nothing is taken of it), and times that the slopes of the light along axisU and axisV for each m along
  // axisW, and the length (m) of its way through the medium.
  std::vector<vec4> texels;
  vec3 color{1};  // of all the light, over the mean of its channels
};

// Of what goes on within 78 degrees of unit `axis`, across which the layers stand; without texels where there
// is none. A beam's light begins as far before its start as the surface is rough, and a layer
// more, and ends a layer behind what it meets, so that none is missing between. All its flux
// is in each layer that it crosses within the grid.
LightLayers lightInLayers(std::span<const Beam> beams, vec3 axis, const LayerSettings& settings);

}  // namespace nephroid

#endif

#endif
