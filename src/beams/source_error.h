// How far a transport source that cannot be refined is off, by comparison with rays that are traced.
#pragma once

#include <optional>
#include <string>

#include "trace/paths.h"
#include "trace/ray_scene.h"
#include "transport/source.h"
#include "transport/traced/traced_source.h"

namespace nephroid {

// The mean error (0..1) of the light that `source` sends on, over all light that goes through casters:
// between the vertices of a triangle, light that its rays take other ways is lost, and light of another
// spread is as wrong as its density. Of many emitters and triangles, it looks at a part. Traces a ray for
// each vertex, and four for each triangle.
double sourceError(const Scene& scene, const RayScene& rays, const TransportSource& source,
                   const TracedSource& traced, Paths paths);

// A sentence where that is more than a tenth.
std::optional<std::string> sourceErrorNote(const Scene& scene, const RayScene& rays,
                                           const TransportSource& source, const TracedSource& traced,
                                           Paths paths);

}  // namespace nephroid
