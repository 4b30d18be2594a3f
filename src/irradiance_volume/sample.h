// The caustic light around a caster for one light direction, as it is kept.
#pragma once

#include <span>
#include <vector>

#include "irradiance_volume/lookup.h"
#include "irradiance_volume/photons.h"

namespace nephroid {

// How a sample's words stand for its region. In the sample's frame, bounding radii from the centre.
struct SampleLayout {
  vec3 corner{0};           // where place 0 lies
  float placesPerUnit = 1;  // of lookup.h, a bounding radius
  uvec3 size{0};            // VolumeView::size
  uint32_t words = 0;
  vec3 source{0};         // what light beyond the region spreads from, in the region's radii
  uint32_t flowSide = 0;  // of the lattice of movements (flow.h) that the words end with; 0 for none
  bool operator==(const SampleLayout&) const = default;
};

struct VolumeSample {
  SampleLayout layout;
  std::vector<uint32_t> words;
};

// How a sample's light is displaced for another direction of the light: a FlowView's values, in places.
struct LightFlow {
  vec3 origin{0};
  vec3 scale{1};
  uint32_t side = 0;
  std::vector<vec3> moves;
};

inline FlowView viewOf(const LightFlow& flow) {
  return {flow.origin, flow.scale, flow.side, flow.moves.data()};
}

// What a processor sees at `place`, in the sample's frame, bounding radii from the centre.
VolumeLight lightAt(const SampleLayout& layout, std::span<const uint32_t> words, uint32_t representation,
                    vec3 place, const LightFlow& flow = {});

// What the light of the paths, that end `radius` from the centre, spreads from there on: the place that their
// lines pass nearest to, in that radius. Far away where they are parallel.
vec3 spreadSource(std::span<const PhotonPath> paths, float radius);

// A cell being filled.
struct CellSum {
  vec3 vector{0};  // mean over the channels
  vec3 color{0};
};

// The two words of a cell.
void packCell(const CellSum& cell, uint32_t* words);

}  // namespace nephroid
