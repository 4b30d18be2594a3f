// Packs rays from any tracer into a light transport table.
#pragma once

#include <functional>
#include <span>

#include "transport/table/table.h"

namespace nephroid {

// Computes the rays that leave the mesh, for light that meets `vertex` along each of `directions` (unit). All
// in mesh space. The first channel of a ray's transmittance is that of all boundaries, with the entry. Called
// from several threads.
using VertexTracer = std::function<void(uint32_t vertex, float ior, std::span<const vec3> directions,
                                        std::span<OutgoingRay> rays)>;

TransportTable fillTable(const TableKey& key, const Mesh& mesh, const VertexTracer& trace,
                         Progress& progress);

}  // namespace nephroid
