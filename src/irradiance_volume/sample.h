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
  bool operator==(const SampleLayout&) const = default;
};

struct VolumeSample {
  SampleLayout layout;
  std::vector<uint32_t> words;
};

// What a processor sees at `place`, in the sample's frame, bounding radii from the centre.
VolumeLight lightAt(const SampleLayout& layout, std::span<const uint32_t> words, uint32_t representation,
                    vec3 place);

// A cell being filled.
struct CellSum {
  vec3 vector{0};  // mean over the channels
  vec3 color{0};
};

// The two words of a cell.
void packCell(const CellSum& cell, uint32_t* words);

}  // namespace nephroid
