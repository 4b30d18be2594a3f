// Illumination textures (Iwasaki, Dobashi, Yoshimoto and Nishita 2005): caustics on receivers of any shape by
// way of textures on virtual planes around them. What is made does not depend on the view.
#pragma once

#include <memory>

#include "techniques/registry.h"

namespace nephroid {

std::unique_ptr<Technique> makeIlluminationTextures(const TechniqueContext& context);

}  // namespace nephroid
