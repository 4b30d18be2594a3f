#include "render/air/settings.h"

namespace nephroid {
namespace {

// Users give it in thousandths.
constexpr Setting errorSetting() {
  Setting error = wholeSetting<&ShaftSettings::error>("air-error", 1, 1000,
                                                      "Mean error of shafts of light, in thousandths of "
                                                      "their mean, for which the number of planes is chosen");
  error.get = [](const void* owner) {
    return 1000 * double(static_cast<const ShaftSettings*>(owner)->error) + 1e-4;
  };
  error.set = [](void* owner, double value) {
    static_cast<ShaftSettings*>(owner)->error = static_cast<float>(value) / 1000;
  };
  return error;
}

}  // namespace

std::span<const Setting> shaftSettings() {
  static constexpr Setting kSettings[] = {
      wholeSetting<&ShaftSettings::planes>(
          "air-planes", 0, 10000,
          "Sampling planes of shafts of light on each ray; 0: as many as --air-error needs, for each light"),
      wholeSetting<&ShaftSettings::subplanes>(
          "air-subplanes", 0, 256,
          "Sub-sample planes between two sampling planes, used "
          "everywhere; 0: as many as --air-error needs, used only where light changes"),
      errorSetting(),
  };
  return kSettings;
}

}  // namespace nephroid
