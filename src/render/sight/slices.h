// Chooses the slices for the view through casters.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/sight/view_rays.h"

namespace nephroid {

// A receiver's box. World space, m.
struct ReceiverBounds {
  uint32_t object = 0;
  std::array<vec3, 8> corners{};
};

// Sample planes across the mean direction in which view rays leave the caster. They reach from the caster to
// the farthest receiver, and are wide enough for all view rays but a few percent. `count`: the number of
// slices; 0: a number that fits the depth of the receivers. The result has no slices where no receiver is
// seen. `center`, `radius`: m, of the caster.
SliceSet planSlices(const SightMesh& sight, vec3 center, float radius,
                    std::span<const ReceiverBounds> receivers, uint32_t count);

// The range of depths (m) of a receiver along the frame's axis.
vec2 depthsIn(const SightFrame& frame, const ReceiverBounds& receiver);

// Whether a receiver may be seen between two depths.
bool isSeen(const SightFrame& frame, vec2 depths, const ReceiverBounds& receiver);

}  // namespace nephroid
