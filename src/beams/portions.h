// Portions of the light of one lamp through one caster, and where they arrive.
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

// m along the axis, of what is nearest in the boxes.
float nearestAlong(vec3 axis, std::span<const ReceiverBox> boxes);

// Where a box may stop light.
struct Arrival {
  vec3 point;  // m
  float flux;  // lm, of all channels
};

// Of as many beams as tell where all of them arrive. Without an axis all count; with one, those whose cosine
// with it is less than `leastApproach` are left out.
std::vector<Arrival> findArrivals(std::span<const Beam> beams, std::span<const ReceiverBox> boxes,
                                  vec3 axis = vec3(0), float leastApproach = 0);

struct LightPortion {
  vec3 axis{0};  // unit, that planes may stand across; zero where light goes all ways alike
  std::vector<Beam> beams;
  float leastApproach = 0;  // cosine with the axis of nearly all rays in it
};

// Portions of light that planes across an axis each can hold: all of it, across its mean; or, where too much
// arrives aside of that, what goes the way that most of it arrives, and the rest by octants of the world.
std::vector<LightPortion> portionsByAxis(std::vector<Beam> beams, std::span<const ReceiverBox> boxes);

}  // namespace nephroid
