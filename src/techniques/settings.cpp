#include "techniques/settings.h"

namespace nephroid {

std::span<const SettingField> settingFields() {
  using Settings = TechniqueSettings;
  static constexpr SettingField kFields[] = {
      {"planes", "Virtual planes that caustics are drawn on, around the receivers", &Settings::planes, 1, 256,
       "sensor"},
      {"texture-size", "Texels along each side of a virtual plane", &Settings::textureSize, 16, 8192,
       nullptr},
      {"directions", "Light directions held for each vertex of a light transport table",
       &Settings::directions, 9, 65535, nullptr},
      {"refine-depth", "How many times a beam may be divided where the light within it goes different ways",
       &Settings::refineDepth, 0, 8, nullptr},
  };
  return kFields;
}

}  // namespace nephroid
