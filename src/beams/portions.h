// Portions of the light of one lamp through one caster, and the places where it arrives.
#pragma once

#include <span>
#include <vector>

#include "beams/beam.h"
#include "geometry/box.h"
#include "scene/scene.h"

namespace nephroid {

// The box of an opaque object's mesh, in the object's own space.
struct ReceiverBox {
  Placement placement;
  Box box;
};

std::vector<ReceiverBox> receiverBoxes(const Scene& scene);

// The smallest coordinate (m) of the boxes along the axis (unit).
float nearestAlong(vec3 axis, std::span<const ReceiverBox> boxes);

// A place where a beam enters a receiver's box, so that its light may arrive there.
struct Arrival {
  vec3 point;  // m
  float flux;  // lm, of all channels
};

// Finds arrivals for a sample of the beams that is large enough to represent all of them. With an axis
// (unit), beams whose cosine with it is less than `leastApproach` are left out. An axis of zero: all beams
// count.
std::vector<Arrival> findArrivals(std::span<const Beam> beams, std::span<const ReceiverBox> boxes,
                                  vec3 axis = vec3(0), float leastApproach = 0);

struct LightPortion {
  vec3 axis{0};  // unit, the mean direction, across which planes may stand; zero where light goes in all
                 // directions alike
  std::vector<Beam> beams;
  float leastApproach = 0;  // cosine with the axis of nearly all rays in it
};

// Divides beams into portions, so that planes across the axis of each can hold its light. Usually that is one
// portion, with the mean direction as its axis. Where too much light arrives far from the mean direction, the
// first portion has the light around the direction in which most of it arrives, and the rest is divided by
// octants of the world's directions.
std::vector<LightPortion> portionsByAxis(std::vector<Beam> beams, std::span<const ReceiverBox> boxes);

}  // namespace nephroid
