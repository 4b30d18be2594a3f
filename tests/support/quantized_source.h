#pragma once

#include <cmath>

#include "core/octahedral.h"
#include "geometry/bounds.h"
#include "transport/traced/traced_source.h"

namespace nephroid {

inline float quantized(float value) {
  return std::round(glm::clamp(value, 0.0f, 1.0f) * 65535.0f) / 65535.0f;
}

// Traced rays at the vertices, kept in as many bits as a table keeps them in.
class QuantizedSource : public TransportSource {
 public:
  QuantizedSource(const Scene& sceneOf, const TracedSource& tracedOf, bool isExactOf)
      : scene(sceneOf), traced(tracedOf), isExact(isExactOf) {}

  void vertexRays(const TransportQuery& query, std::span<OutgoingRay> rays) const override {
    traced.vertexRays(query, rays);
    if (isExact) return;
    const Object& object = scene.objects[query.object];
    const auto [low, high] = boundingBox(scene.meshOf(object));
    for (OutgoingRay& ray : rays) {
      vec3 place = (object.placement.inversePoint(ray.position) - low) / (high - low);
      for (int i = 0; i < 3; ++i) place[i] = quantized(place[i]);
      ray.position = object.placement.point(low + place * (high - low));
      const vec2 square = octahedralFromDirection(object.placement.inverseDirection(ray.direction));
      ray.direction =
          object.placement.direction(directionFromOctahedral({quantized(square.x), quantized(square.y)}));
      ray.transmittance = vec3(quantized(ray.transmittance.x));
    }
  }
  bool refines(const TransportQuery&) const override { return false; }
  OutgoingRay rayAt(const TransportQuery& query, const SurfacePoint& point) const override {
    return traced.rayAt(query, point);
  }

 private:
  const Scene& scene;
  const TracedSource& traced;
  bool isExact;
};

}  // namespace nephroid
