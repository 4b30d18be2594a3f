// Caustics by the light volumes themselves, each pixel by the beams it lies in (Barczak and Olano,
// "Interactive Shadowed Caustics Using Hierarchical Light Volumes").
#pragma once

#include "techniques/registry.h"

namespace nephroid {

std::unique_ptr<Technique> makeLightVolumes(const TechniqueContext& context);

}  // namespace nephroid
