// The light of scenes that have none.
#pragma once

#include "scene/scene.h"

namespace nephroid {

// Adds a clear sky and its sun to a scene without lights and ambient light. `isBackgroundGiven`: the sky is
// not seen.
void lightByDefault(Scene& scene, bool isBackgroundGiven);

}  // namespace nephroid
