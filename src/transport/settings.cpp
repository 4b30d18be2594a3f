#include "transport/settings.h"

namespace nephroid {

std::span<const Setting> transportSettings() {
  using Settings = TransportSettings;
  static constexpr Setting kSettings[] = {
      choiceSetting<&Settings::source>(
          "source",
          "How the rays that leave a caster are found. table: by a light transport table, for smooth glass "
          "without anything in it, otherwise traced, and it is told where that is off by more than a tenth; "
          "traced: traced for each frame"),
      choiceSetting<&Settings::paths>("paths",
                                      "The paths of light that are followed. transmission: refraction only; "
                                      "all: reflection outside and inside casters too",
                                      true),
      wholeSetting<&Settings::directions>(
          "directions", 9, 65535, "Light directions kept for each vertex of a light transport table", true),
  };
  return kSettings;
}

}  // namespace nephroid
