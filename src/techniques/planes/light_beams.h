// The beams of a scene's lights, in the portions that share planes.
#pragma once

#include <span>
#include <vector>

#include "beams/build.h"
#include "techniques/sources.h"
#include "transport/queries.h"

namespace nephroid {

// For each portion what is to be asked: light of one lamp through one caster, along one choice of
// reflections. The points of a line are one lamp as far as they shine on the caster from nearly one
// direction.
std::vector<std::vector<BandQuery>> lightThroughCasters(const SceneTransport& transport, Paths paths);

// The beams of all these queries, in their order.
std::vector<Beam> beamsOf(const Scene& scene, const TransportSource& source,
                          std::span<const BandQuery> queries, const BeamSettings& settings);

// Whether all have the same colour, so that one channel and a tint tell all.
bool areOfOneColor(std::span<const Beam> beams);

}  // namespace nephroid
