#include "render/sight/settings.h"

namespace nephroid {

std::span<const Setting> sightSettings() {
  static constexpr Setting kSettings[] = {
      wholeSetting<&SightSettings::slices>("sight-slices", 0, 16,
                                           "Sliced object images in which it is looked up what glass shows; "
                                           "0: as many as the receivers' depth "
                                           "asks for"),
  };
  return kSettings;
}

}  // namespace nephroid
