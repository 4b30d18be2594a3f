#include "transport/settings.h"

namespace nephroid {

std::span<const Setting> transportSettings() {
  using Settings = TransportSettings;
  static constexpr Setting kSettings[] = {
      choiceSetting<&Settings::source>(
          "source",
          "Where the rays that leave a caster come from: a light transport table, where smooth glass without "
          "anything in it allows one, or traced now"),
      choiceSetting<&Settings::paths>(
          "paths", "Follow light by refraction alone, or by reflection outside and inside as well", true),
      wholeSetting<&Settings::directions>(
          "directions", 9, 65535, "Light directions kept for each vertex of a light transport table", true),
  };
  return kSettings;
}

}  // namespace nephroid
