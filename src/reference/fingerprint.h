#pragma once

#include "scene/scene.h"

namespace nephroid {

// A hash of all that the light in a scene depends on: two scenes with the same may be taken for the same.
uint64_t fingerprint(const Scene& scene);

}  // namespace nephroid
