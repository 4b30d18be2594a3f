// The beams of a scene's lights, in the portions that share planes.
#pragma once

#include <span>
#include <vector>

#include "beams/build.h"
#include "beams/portions.h"
#include "beams/settings.h"
#include "transport/queries.h"
#include "transport/scene_transport.h"

namespace nephroid {

// Which casters' light a technique takes.
enum class Casters { all, water, solid };

// For each portion what is to be asked: light of one lamp through one caster, along one choice of
// reflections. The points of a line are one lamp as far as they shine on the caster from nearly one
// direction.
std::vector<std::vector<BandQuery>> lightThroughCasters(const SceneTransport& transport, Paths paths,
                                                        Casters casters);

// The beams of all these queries, in their order.
std::vector<Beam> beamsOf(const Scene& scene, const TransportSource& source,
                          std::span<const BandQuery> queries, const BeamSettings& settings);

// The beams of one portion, of triangles cut where the light within them parts or bends on its way to the
// receivers in `boxes`. Where beams bend is judged on planes about where the light arrives, of `detail`
// texels along each side.
std::vector<Beam> refinedBeams(const Scene& scene, const TransportSource& source,
                               std::span<const BandQuery> queries, std::span<const ReceiverBox> boxes,
                               const BeamDivision& division, uint32_t detail);

// Takes the weakest beams of all portions out, which carry no more than `part` of the flux between them.
void leaveOutWeakest(std::vector<std::vector<Beam>>& portions, double part);

// Whether all have the same colour, so that one channel and a tint tell all.
bool areOfOneColor(std::span<const Beam> beams);

}  // namespace nephroid
