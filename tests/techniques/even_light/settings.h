#pragma once

#include "core/settings.h"

namespace nephroid {

struct EvenLightSettings {
  double lux = 1;  // on every receiver
  bool operator==(const EvenLightSettings&) const = default;
};

}  // namespace nephroid
