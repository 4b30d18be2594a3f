// Chooses where virtual planes stand.
#pragma once

#include <span>

#include "beams/plane_set.h"
#include "beams/portions.h"

namespace nephroid {

// How many planes, of which size, across which axis.
struct PlaneOrder {
  vec3 axis{0};            // unit
  float nearestDepth = 0;  // m along the axis, where the virtual camera begins to see
  uint32_t planes = 1;
  uint32_t textureSize = 512;  // texels along a side
};

// Planes from the nearest to the farthest arrival, with windows around all arrivals. One plane where all
// arrivals have the same depth; no planes where there are no arrivals.
PlaneSet planPlanes(const PlaneOrder& order, std::span<const Beam> beams, std::span<const Arrival> arrivals);

// Planes across the portion's axis (Iwasaki 2005b, 4.2: the mean direction of the light).
PlaneSet planAlongLight(const LightPortion& portion, std::span<const ReceiverBox> boxes, uint32_t planes,
                        uint32_t textureSize);

}  // namespace nephroid
