// The beams of a scene's lights, divided into portions.
#pragma once

#include <span>
#include <vector>

#include "beams/build.h"
#include "beams/portions.h"
#include "beams/settings.h"
#include "transport/queries.h"
#include "transport/scene_transport.h"

namespace nephroid {

// The casters whose light a technique draws.
enum class Casters { all, water, solid };

// The queries for each portion of the light: one lamp, one caster, one choice of reflections. Several points
// of a line count as one lamp where they light the caster from nearly the same direction.
std::vector<std::vector<BandQuery>> lightThroughCasters(const SceneTransport& transport, Paths paths,
                                                        Casters casters);

// The beams of these queries, in order.
std::vector<Beam> beamsOf(const Scene& scene, const TransportSource& source,
                          std::span<const BandQuery> queries, const BeamSettings& settings);

// The beams of one portion. Triangles are cut where their light takes different paths or bends on its way to
// the receivers in `boxes`. Bending is tested on planes near the receivers, with `detail` texels along each
// side.
std::vector<Beam> refinedBeams(const Scene& scene, const TransportSource& source,
                               std::span<const BandQuery> queries, std::span<const ReceiverBox> boxes,
                               const BeamDivision& division, uint32_t detail);

// Removes the weakest beams of all portions; together they carry at most the part `part` (0..1) of the flux.
void leaveOutWeakest(std::vector<std::vector<Beam>>& portions, double part);

// Whether all beams have the same color, so that one channel and a tint are enough.
bool areOfOneColor(std::span<const Beam> beams);

}  // namespace nephroid
