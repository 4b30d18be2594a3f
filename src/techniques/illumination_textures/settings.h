#pragma once

#include "core/settings.h"

namespace nephroid {

struct IlluminationTextureSettings {
  uint32_t planes = 4;  // virtual planes; 0: a sensor is measured by a single one, in its own plane
  bool operator==(const IlluminationTextureSettings&) const = default;
};

}  // namespace nephroid
