// Where virtual planes stand across the light.
#pragma once

#include <span>

#include "beams/plane_set.h"
#include "beams/portions.h"

namespace nephroid {

// How planes stand, and how far along their axis the virtual camera begins to see.
struct PlaneOrder {
  vec3 axis{0};  // unit
  float nearestDepth = 0;
  uint32_t planes = 1;
  uint32_t textureSize = 512;
};

// From the nearest to the farthest arrival, with windows about all of them. One plane where all arrive at one
// depth; of no planes without arrivals.
PlaneSet planPlanes(const PlaneOrder& order, std::span<const Beam> beams, std::span<const Arrival> arrivals);

// Planes across the portion's axis (Iwasaki 2005b, 4.2: the mean direction of the light).
PlaneSet planAlongLight(const LightPortion& portion, std::span<const ReceiverBox> boxes, uint32_t planes,
                        uint32_t textureSize);

}  // namespace nephroid
