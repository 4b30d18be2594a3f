// Tells whether passes can be added to those of before.
#pragma once

#include "scene/scene.h"

namespace nephroid {

// A hash of everything that the light in a scene depends on, and of the method of the reference. Passes of
// equal hashes, and of equal settings, belong to the same estimate.
uint64_t fingerprint(const Scene& scene);

}  // namespace nephroid
