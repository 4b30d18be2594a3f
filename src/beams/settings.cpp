#include "beams/settings.h"

namespace nephroid {

std::span<const Setting> beamSettings() {
  static constexpr Setting kSettings[] = {
      wholeSetting<&BeamDivision::refineDepth>(
          "refine-depth", 0, 8,
          "How many times a beam may be divided where the light within it takes different paths"),
      realSetting<&BeamDivision::shadowTolerance>(
          "shadow-tolerance", 0, 1,
          "The part (0 to 1) of a cell of water that may be in shadow before the light of the whole cell is "
          "left out; with 1 only cells in full shadow are left out"),
  };
  return kSettings;
}

}  // namespace nephroid
