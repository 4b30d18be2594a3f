// Beams between the outgoing rays of a caster's triangles (illumination volumes; Nishita and Nakamae 1994,
// Iwasaki 2005).
#pragma once

#include <vector>

#include "beams/beam.h"
#include "beams/footprint.h"
#include "lights/light_intensity.h"
#include "transport/source.h"

namespace nephroid {

// A plane on which bending is judged, of rays that go through it at no less than a cosine.
struct BeamTarget {
  PlaneGrid plane;
  float leastApproach = 0;
};

struct BeamSettings {
  // Times a triangle may be cut in four where its rays take different ways or bend (sources that can trace
  // anywhere).
  uint32_t refineDepth = 3;
  // Texels of `targets` that the ray of a side's midpoint may lie off the middle of its ends' before the
  // triangle is cut.
  float refineTolerance = 0.1f;
  // Where it is judged whether rays bend. Without any, triangles are cut where their corners' rays part,
  // alone.
  std::vector<BeamTarget> targets;
  // Only rays that go on through other casters are taken to bend.
  bool isEvenAtSurface = false;
  // Light is wanted on the first target itself, so rays that meet an opaque surface before it carry none.
  bool stopAtSurfaces = false;
  // The part of a cell of water's corners that may be in shadow before the cell passes no light (Barczak and
  // Olano, 3.4, whose leaves of several cells are counted in a shadow map).
  float shadowTolerance = 1;
};

struct BeamSet {
  std::vector<Beam> beams;
  vec3 incidentFlux{0};  // lm onto the lit triangles of the caster, in this band
  uint64_t triangles = 0;
  uint64_t refined = 0;  // triangles that were cut
  uint64_t split = 0;    // beams whose corners took different ways to the end, shared out corner by corner
};

// The beams of one query. `bandColor` is the part of each channel that travels in the query's band: (1, 1, 1)
// where all channels are bent alike. The order of the beams does not depend on the number of threads.
BeamSet buildBeams(const Scene& scene, const TransportSource& source, const TransportQuery& query,
                   vec3 bandColor, const BeamSettings& settings);

}  // namespace nephroid
