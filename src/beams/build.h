// Beams between the outgoing rays of a caster's triangles (illumination volumes; Nishita and Nakamae 1994,
// Iwasaki 2005).
#pragma once

#include <vector>

#include "beams/beam.h"
#include "beams/footprint.h"
#include "lights/light_intensity.h"
#include "transport/source.h"

namespace nephroid {

// A plane on which it is tested whether rays bend. Only rays count whose cosine with the normal is at least
// `leastApproach`.
struct BeamTarget {
  PlaneGrid plane;
  float leastApproach = 0;
};

struct BeamSettings {
  // How many times a triangle may be cut into four where its rays take different paths or bend. Only for
  // sources that can trace from any point.
  uint32_t refineDepth = 3;
  // Texels of `targets`. A triangle is cut where the ray from the middle of a side meets the plane farther
  // than this from the middle between the rays from the side's ends.
  float refineTolerance = 0.1f;
  // The planes on which bending is tested. Without any, triangles are cut only where the rays of their
  // corners take different paths.
  std::vector<BeamTarget> targets;
  // Test for bending only those rays that go on through other casters.
  bool isEvenAtSurface = false;
  // Light is wanted on the first target itself, so rays that meet an opaque surface before it carry no light.
  bool stopAtSurfaces = false;
  // 0..1. A cell of water passes no light where a larger part of its corners than this is in shadow (Barczak
  // and Olano, 3.4, who count the cells of a leaf in a shadow map).
  float shadowTolerance = 1;
};

struct BeamSet {
  std::vector<Beam> beams;
  vec3 incidentFlux{0};  // lm onto the lit triangles of the caster, in this band
  uint64_t triangles = 0;
  uint64_t refined = 0;  // triangles that were cut
  uint64_t split = 0;  // beams whose corners still take different paths after all cuts; their flux is divided
                       // among the corners
};

// The beams of one query. `bandColor`: the part (0..1) of each color channel that belongs to the query's
// band; (1, 1, 1) where all channels are refracted alike. The order of the beams does not depend on the
// number of threads.
BeamSet buildBeams(const Scene& scene, const TransportSource& source, const TransportQuery& query,
                   vec3 bandColor, const BeamSettings& settings);

}  // namespace nephroid
