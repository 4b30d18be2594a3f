// Where the images of receivers that glass and mirrors show are taken from.
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

// Sample planes across the mean direction in which sight leaves the caster, from where it leaves it to the
// farthest receiver, wide enough for all but the last few per cent of it. `count` of 0: as many as the depth
// of the receivers asks for. Of no slices when nothing is to be seen.
SliceSet planSlices(const SightMesh& sight, vec3 center, float radius,
                    std::span<const ReceiverBounds> receivers, uint32_t count);

// Depths (m) along a frame's axis between which a receiver lies.
vec2 depthsIn(const SightFrame& frame, const ReceiverBounds& receiver);

// Whether a receiver may be seen between two depths.
bool isSeen(const SightFrame& frame, vec2 depths, const ReceiverBounds& receiver);

}  // namespace nephroid
