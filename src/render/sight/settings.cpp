#include "render/sight/settings.h"

namespace nephroid {

std::span<const Setting> sightSettings() {
  static constexpr Setting kSettings[] = {
      wholeSetting<&SightSettings::slices>("sight-slices", 0, 16,
                                           "Number of sliced object images, in which the view through glass "
                                           "is looked up; 0: a number that fits the receivers' depth"),
  };
  return kSettings;
}

}  // namespace nephroid
