// Settings of the samples of a pixel.
#pragma once

#include "core/settings.h"

namespace nephroid {

struct SampleSettings {
  uint32_t count = 16;
  bool operator==(const SampleSettings&) const = default;
};

std::span<const Setting> sampleSettings();

}  // namespace nephroid
