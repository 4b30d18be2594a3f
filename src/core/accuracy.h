// How far a result may be off, and what it may take, whichever technique or reference makes it.
#pragma once

#include "core/settings.h"

namespace nephroid {

struct Accuracy {
  float error = 0.01f;  // root mean square over the mean of what is lit; of the reference its standard error
  uint32_t memory = 1024;  // MiB that beams, their paths and their light may take
  bool operator==(const Accuracy&) const = default;
};

inline constexpr Setting kAccuracySettings[] = {
    fractionSetting<&Accuracy::error>("error", 1,
                                      "Error that the light of beams may have, of the mean of what is lit; "
                                      "where it is given, the reference "
                                      "stops at this standard error of the caustics"),
    wholeSetting<&Accuracy::memory>("memory", 16, 1 << 20,
                                    "MiB that beams, their paths and their light may take; where they are "
                                    "too few the stats tell the error that was reached"),
};

}  // namespace nephroid
