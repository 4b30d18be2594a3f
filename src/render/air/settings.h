// Settings of shafts of light in the air.
#pragma once

#include "core/settings.h"

namespace nephroid {

struct ShaftSettings {
  uint32_t planes = 0;     // sampling planes on each ray; 0: as many as `error` needs
  uint32_t subplanes = 0;  // sub-sample planes of each, used everywhere; 0: as many as `error` needs, used
                           // only where light changes
  float error = 0.004f;    // the mean error, divided by the mean luminance, for which planes are chosen
  bool operator==(const ShaftSettings&) const = default;
};

std::span<const Setting> shaftSettings();

}  // namespace nephroid
