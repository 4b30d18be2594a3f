// Packs rays, wherever they come from, into a light transport table.
#pragma once

#include <functional>
#include <span>

#include "transport/table/table.h"

namespace nephroid {

// Answers, for light that meets `vertex` along `directions` (unit, mesh space), the rays that leave the mesh,
// in mesh space, with the transmittance of all boundaries, the entry included, in its first channel. Called
// from many threads.
using VertexTracer = std::function<void(uint32_t vertex, float ior, std::span<const vec3> directions,
                                        std::span<OutgoingRay> rays)>;

TransportTable fillTable(const TableKey& key, const Mesh& mesh, const VertexTracer& trace,
                         Progress& progress);

}  // namespace nephroid
