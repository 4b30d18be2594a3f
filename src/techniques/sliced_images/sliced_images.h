// Sliced object images (Iwasaki, Yoshimoto, Dobashi and Nishita 2005, 5.2): caustics maps on sample planes
// across the mean direction in which the receivers are seen. They are made anew when the camera moves.
#pragma once

#include <memory>

#include "techniques/registry.h"

namespace nephroid {

std::unique_ptr<Technique> makeSlicedImages(const TechniqueContext& context);

}  // namespace nephroid
