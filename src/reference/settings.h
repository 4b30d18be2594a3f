// The settings of the reference that a user may choose.
#pragma once

#include <array>

#include "core/settings.h"
#include "reference/refine.h"

namespace nephroid {

// automatic: channels where only refraction is followed, as in the papers; otherwise continuous.
enum class SpectrumChoice { automatic, channels, continuous };

inline constexpr std::array<const char*, 3> kSpectrumChoiceNames{"automatic", "channels", "continuous"};
constexpr const auto& namesOf(SpectrumChoice) {
  return kSpectrumChoiceNames;
}

struct ReferenceChoices {
  uint32_t passes = 0;  // stop after this many; 0: no limit
  double seconds = 0;   // stop after this time (s); 0: no limit
  uint64_t seed = 1;
  uint32_t photons = 1u << 22;  // of a pass
  SpectrumChoice spectrum = SpectrumChoice::automatic;
};

std::span<const Setting> referenceSettings();

// The settings for an image or a sensor of `size` (pixels or texels).
ReferenceSettings referenceSettingsOf(const ReferenceChoices& choices, Paths paths, uvec2 size);

// The stop rule of these choices and of a relative standard error (0: no limit); 16 passes where there is no
// limit at all.
StopRule stopRuleOf(const ReferenceChoices& choices, double error);

}  // namespace nephroid
