#pragma once

#include <algorithm>

#include "scene/scene.h"

namespace nephroid {

// Gives a dielectric the index `ior` at the d line and the Abbe number 20 / dispersion
// (KHR_materials_dispersion); 0: none. Red and blue lie as far from green as the extension has it.
inline void setDispersion(Material& material, double ior, double dispersion) {
  const double halfSpread = std::min((ior - 1) * 0.025 * dispersion, ior - 1);
  material.dispersion = static_cast<float>(dispersion);
  material.ior = vec3(ior - halfSpread, ior, ior + halfSpread);
}

}  // namespace nephroid
