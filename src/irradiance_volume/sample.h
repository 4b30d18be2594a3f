// The stored caustic light around a caster for one light direction.
#pragma once

#include <span>
#include <vector>

#include "irradiance_volume/lookup.h"
#include "irradiance_volume/photons.h"

namespace nephroid {

// How the words of a sample cover its region. In the sample's frame, in bounding radii from the center.
struct SampleLayout {
  vec3 corner{0};           // the point of place (0, 0, 0)
  float placesPerUnit = 1;  // places (the coordinates of lookup.h) per bounding radius
  uvec3 size{0};            // VolumeView::size
  uint32_t words = 0;
  vec3 source{0};  // the point from which light beyond the region spreads, in the region's radii
  uint32_t flowSide =
      0;  // nodes along a side of the lattice of displacements (flow.h) at the end of the words; 0: none
  bool operator==(const SampleLayout&) const = default;
};

struct VolumeSample {
  SampleLayout layout;
  std::vector<uint32_t> words;
};

// The displacements of a sample for another direction of the light, as in FlowView, in units of places.
struct LightFlow {
  vec3 origin{0};
  vec3 scale{1};
  uint32_t side = 0;
  std::vector<vec3> moves;
};

inline FlowView viewOf(const LightFlow& flow) {
  return {flow.origin, flow.scale, flow.side, flow.moves.data()};
}

// The light at `place` (in the sample's frame, in bounding radii from the center), computed on the processor.
VolumeLight lightAt(const SampleLayout& layout, std::span<const uint32_t> words, uint32_t representation,
                    vec3 place, const LightFlow& flow = {});

// The point from which light beyond the region spreads: the point nearest to the lines of all paths, in units
// of `radius`, the region's radius. Far away where the paths are parallel.
vec3 spreadSource(std::span<const PhotonPath> paths, float radius);

// The sum of the light in a cell, while it is filled.
struct CellSum {
  vec3 vector{0};  // mean over the channels
  vec3 color{0};
};

// Writes the two words of a cell.
void packCell(const CellSum& cell, uint32_t* words);

}  // namespace nephroid
