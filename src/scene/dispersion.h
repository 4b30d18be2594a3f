// The indices of refraction of the color channels from a dispersion.
#pragma once

#include <algorithm>

#include "scene/scene.h"

namespace nephroid {

// Sets the index `ior` at the d line (587.6 nm) and the Abbe number 20 / dispersion of a dielectric; a
// dispersion of 0: none. The indices of red and blue follow KHR_materials_dispersion.
inline void setDispersion(Material& material, double ior, double dispersion) {
  const double halfSpread = std::min((ior - 1) * 0.025 * dispersion, ior - 1);
  material.dispersion = static_cast<float>(dispersion);
  material.ior = vec3(ior - halfSpread, ior, ior + halfSpread);
}

}  // namespace nephroid
