#include <oneapi/tbb/parallel_for.h>

#include "core/index_range.h"
#include "scene/volume.h"
#include "transport/table/table.h"

namespace nephroid {

OutgoingRay lookUp(const TransportTable& table, uint32_t vertex, vec3 direction, uint32_t band) {
  return lookUpRay(table.view(), table.view().bands == 1 ? 0 : band, vertex, direction);
}

void tableRays(const TransportTable& table, const Mesh& mesh, const Placement& placement,
               const Material& material, const Emitter& emitter, uint32_t band, std::span<OutgoingRay> rays) {
  oneapi::tbb::parallel_for(IndexRange(0, rays.size(), 256), [&](const IndexRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const vec3 incident = emitterDirection(emitter, placement.point(mesh.positions[i]));
      const vec3 local = placement.inverseDirection(incident) * vertexFrame(mesh.normals[i]);
      OutgoingRay ray = lookUp(table, static_cast<uint32_t>(i), local, band);
      ray.position = placement.point(ray.position);
      ray.direction = placement.direction(ray.direction);
      ray.pathLength *= placement.scale;
      ray.transmittance *= transmittanceOf(material, ray.pathLength);
      rays[i] = ray;
    }
  });
}

}  // namespace nephroid
