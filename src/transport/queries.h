#pragma once

#include <vector>

#include "scene/scene.h"
#include "transport/traced/traced_source.h"

namespace nephroid {

// A query, and the part of each colour channel that travels in its band.
struct BandQuery {
  TransportQuery query;
  vec3 bandColor{1};
};

// All that has to be asked to know the light of `emitter` through one caster: one band, or three where the
// caster or another one disperses; for Paths::all one generation per choice of reflections that carries light
// worth having.
std::vector<BandQuery> queriesFor(const Scene& scene, uint32_t object, const Emitter& emitter,
                                  const MediumStack& mediaAround, Paths paths);

// The choices of reflections (TransportQuery::reflections) that carry light worth having through a caster of
// `material`.
std::vector<uint32_t> reflectionChoices(const Material& material, Paths paths);

}  // namespace nephroid
