// The settings of illumination textures.
#pragma once

#include "core/settings.h"

namespace nephroid {

struct IlluminationTextureSettings {
  uint32_t planes = 4;  // virtual planes; 0: a sensor is measured with a single plane, its own
  bool operator==(const IlluminationTextureSettings&) const = default;
};

}  // namespace nephroid
