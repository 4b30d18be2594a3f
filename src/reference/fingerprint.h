// Tells whether two scenes have the same light.
#pragma once

#include "scene/scene.h"

namespace nephroid {

// A hash of everything that the light in a scene depends on. Scenes with equal hashes may be treated as the
// same scene.
uint64_t fingerprint(const Scene& scene);

}  // namespace nephroid
