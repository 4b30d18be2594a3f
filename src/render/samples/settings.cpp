#include "render/samples/settings.h"

namespace nephroid {

std::span<const Setting> sampleSettings() {
  static constexpr Setting kSettings[] = {
      wholeSetting<&SampleSettings::count>("samples", 1, 4096,
                                           "Rays of sight in a pixel, weighed by a Blackman-Harris filter of "
                                           "a radius of 1.5 pixels, so that edges are smooth; light is made "
                                           "once for all of them; depth and normals "
                                           "are those of the ray nearest to the middle"),
  };
  return kSettings;
}

}  // namespace nephroid
