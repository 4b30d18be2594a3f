// The queries for a transport source that describe the light of one emitter through one caster.
#pragma once

#include <vector>

#include "scene/scene.h"
#include "transport/traced/traced_source.h"

namespace nephroid {

// A query, and the part (0..1) of each color channel that belongs to its band.
struct BandQuery {
  TransportQuery query;
  vec3 bandColor{1};
};

// All queries for the light of `emitter` through one caster: for one band, or for three where any caster
// disperses. For Paths::all there is one query for each choice of reflections that carries enough light.
std::vector<BandQuery> queriesFor(const Scene& scene, uint32_t object, const Emitter& emitter,
                                  const MediumStack& mediaAround, Paths paths);

// The choices of reflections (TransportQuery::reflections) that carry enough light through a caster of
// `material`.
std::vector<uint32_t> reflectionChoices(const Material& material, Paths paths);

}  // namespace nephroid
