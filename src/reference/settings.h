// What a user may choose about the reference.
#pragma once

#include <array>

#include "core/settings.h"
#include "reference/refine.h"

namespace nephroid {

// automatic: channels with refraction alone, as the papers' model has it; otherwise continuous.
enum class SpectrumChoice { automatic, channels, continuous };

inline constexpr std::array<const char*, 3> kSpectrumChoiceNames{"automatic", "channels", "continuous"};
constexpr const auto& namesOf(SpectrumChoice) {
  return kSpectrumChoiceNames;
}

struct ReferenceChoices {
  uint32_t passes = 0;  // to stop after; 0: not a reason to stop
  double seconds = 0;   // likewise
  double error = 0;     // likewise: relative standard error of the caustics
  uint64_t seed = 1;
  uint32_t photons = 1u << 20;  // of a pass
  SpectrumChoice spectrum = SpectrumChoice::automatic;
};

std::span<const Setting> referenceSettings();

// For an image, or a sensor, of `size`.
ReferenceSettings referenceSettingsOf(const ReferenceChoices& choices, Paths paths, uvec2 size);

// After 64 passes where no reason to stop is chosen.
StopRule stopRuleOf(const ReferenceChoices& choices);

}  // namespace nephroid
