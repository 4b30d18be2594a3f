#include "beams/settings.h"

namespace nephroid {

std::span<const Setting> beamSettings() {
  static constexpr Setting kSettings[] = {
      wholeSetting<&BeamDivision::refineDepth>(
          "refine-depth", 0, 8,
          "How many times a beam may be divided where the light within it goes different ways"),
      realSetting<&BeamDivision::shadowTolerance>(
          "shadow-tolerance", 0, 1,
          "The part of a cell of water that may be in the shadow of what stands above it before the cell's "
          "light is left out; 1 leaves out light in full shadow alone"),
  };
  return kSettings;
}

}  // namespace nephroid
