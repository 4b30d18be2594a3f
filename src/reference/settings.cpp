#include "reference/settings.h"

namespace nephroid {
namespace {

constexpr uint32_t kDefaultPasses = 16;
constexpr double kMostPhotons = 1u << 24;
constexpr double kLargestWhole = 9007199254740992.0;  // up to which doubles hold every whole number

}  // namespace

std::span<const Setting> referenceSettings() {
  using Choices = ReferenceChoices;
  static constexpr Setting kSettings[] = {
      wholeSetting<&Choices::passes>(
          "passes", 1, 1e9, "Stop the reference after so many passes; 16 where no reason to stop is given"),
      realSetting<&Choices::seconds>("seconds", 0.001, 1e9, "Stop it after so many seconds"),
      wholeSetting<&Choices::seed>("seed", 0, kLargestWhole, "The seed of its random numbers"),
      wholeSetting<&Choices::photons>("photons", 1, kMostPhotons, "Photons that it traces in a pass"),
      choiceSetting<&Choices::spectrum>(
          "spectrum",
          "Dispersion in the reference. channels: red, green and blue, each with its own index of "
          "refraction; continuous: wavelengths; automatic: channels with --paths transmission, as in the "
          "techniques, and otherwise continuous"),
  };
  return kSettings;
}

ReferenceSettings referenceSettingsOf(const ReferenceChoices& choices, Paths paths, uvec2 size) {
  ReferenceSettings settings;
  settings.size = size;
  settings.paths = paths;
  const bool hasChannels = choices.spectrum == SpectrumChoice::channels ||
                           (choices.spectrum == SpectrumChoice::automatic && paths == Paths::transmission);
  settings.spectrum = hasChannels ? Spectrum::channels : Spectrum::continuous;
  settings.seed = choices.seed;
  settings.photons = choices.photons;
  return settings;
}

StopRule stopRuleOf(const ReferenceChoices& choices, double error) {
  StopRule rule{choices.passes, choices.seconds, error};
  if (rule.passes == 0 && rule.seconds <= 0 && rule.error <= 0) rule.passes = kDefaultPasses;
  return rule;
}

}  // namespace nephroid
