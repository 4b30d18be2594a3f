#include "render/sight/settings.h"

namespace nephroid {

std::span<const Setting> sightSettings() {
  static constexpr Setting kSettings[] = {
      choiceSetting<&SightSettings::method>(
          "sight",
          "How the view through glass, in mirrors and through water is found. rays: traced for each pixel; "
          "slices: looked up in sliced object images, as in papers 1 and 2 (light-volumes always does so)"),
      wholeSetting<&SightSettings::slices>(
          "sight-slices", 0, 16,
          "Number of sliced object images, in which the view through glass "
          "is looked up with --sight slices; 0: a number that fits the receivers' depth"),
  };
  return kSettings;
}

}  // namespace nephroid
