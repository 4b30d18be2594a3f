// What is asked of the mesh of rays for a picture.
#pragma once

#include "beams/ray_mesh/ray_mesh.h"
#include "core/accuracy.h"
#include "techniques/settings.h"

namespace nephroid {

// `size`: of the picture, in pixels.
RayMeshSettings settingsOfPicture(const Scene& scene, uvec2 size, const TechniqueSettings& settings);

// Paths and light share what the user lets them have.
inline constexpr uint64_t kPartsOfMemory = 2;
inline uint64_t bytesForPaths(const Accuracy& accuracy) {
  return (uint64_t{accuracy.memory} << 20) / kPartsOfMemory;
}

}  // namespace nephroid
