#include "viewer/scene_lines.h"

#include <algorithm>

#include "beams/light_beams.h"
#include "core/image_io.h"
#include "scene/framing.h"

namespace nephroid {
namespace {

constexpr uint32_t kMostCellsAcross = 16;  // that are told apart

float extentOf(const Scene& scene) {
  Box bounds{vec3(0), vec3(0)};
  for (const Object& object : scene.objects)
    if (scene.isCaster(object)) bounds.include(worldBounds(scene, object));
  return std::max(2 * bounds.diagonal(), 1e-3f);
}

// For each vertex that light of a query may meet, the vertex, its place and normal in the world, and its ray.
template <class Use>
void forEachRay(SceneTransport& transport, Paths paths, const Use& use) {
  const Scene& scene = transport.scene();
  for (const std::vector<BandQuery>& portion : lightThroughCasters(transport, paths, Casters::all))
    for (const BandQuery& band : portion) {
      const Object& object = scene.objects[band.query.object];
      const Mesh& mesh = scene.meshOf(object);
      std::vector<OutgoingRay> rays(mesh.positions.size());
      transport.source().vertexRays(band.query, rays);
      for (std::size_t i = 0; i < rays.size(); ++i)
        use(band, object.placement.point(mesh.positions[i]), object.placement.direction(mesh.normals[i]),
            rays[i]);
    }
}

std::size_t rayCount(SceneTransport& transport, Paths paths) {
  const Scene& scene = transport.scene();
  std::size_t count = 0;
  for (const std::vector<BandQuery>& portion : lightThroughCasters(transport, paths, Casters::all))
    for (const BandQuery& band : portion)
      count += scene.meshOf(scene.objects[band.query.object]).positions.size();
  return count;
}

// Whether the emitter's light comes onto the outer side of the surface there.
bool isLit(const BandQuery& band, vec3 position, vec3 normal) {
  const vec3 along = emitterDirection(band.query.emitter, position);
  const float facing = -dot(along, normal);
  return band.query.media.contains(band.query.object) ? facing < 0 : facing > 0;
}

vec3 shownColor(vec3 linear) {
  const float most = std::max({linear.x, linear.y, linear.z, 1e-6f});
  vec3 color = kCarriedColor;
  for (int c = 0; c < 3; ++c) color[c] *= srgbFromLinear(linear[c] / most);
  return color;
}

}  // namespace

std::vector<SceneLine> beamLines(SceneTransport& transport, Paths paths, std::size_t most) {
  const float extent = extentOf(transport.scene());
  // About half of a caster is lit.
  const std::size_t stride = std::max<std::size_t>(rayCount(transport, paths) / (2 * most), 1);
  std::vector<SceneLine> lines;
  std::size_t index = 0;
  forEachRay(transport, paths,
             [&](const BandQuery& band, vec3 position, vec3 normal, const OutgoingRay& ray) {
               if (index++ % stride != 0 || ray.flags != 0 || !isLit(band, position, normal)) return;
               const float reach = std::min(ray.reach, extent);
               lines.push_back({ray.position, ray.position + reach * ray.direction,
                                shownColor(band.bandColor * band.query.emitter.power * ray.transmittance)});
             });
  return lines;
}

std::vector<SceneLine> culledLines(SceneTransport& transport, Paths paths, std::size_t most,
                                   BeamCounts& counts) {
  const float stroke = 0.02f * extentOf(transport.scene());
  const std::size_t stride = std::max<std::size_t>(rayCount(transport, paths) / (2 * most), 1);
  std::vector<SceneLine> lines;
  std::size_t index = 0;
  counts = {};
  forEachRay(
      transport, paths, [&](const BandQuery& band, vec3 position, vec3 normal, const OutgoingRay& ray) {
        const bool isDrawn = index++ % stride == 0;
        const bool isOccluded = (ray.flags & kRayOccluded) != 0;
        if (!isLit(band, position, normal)) {
          ++counts.unlit;
        } else if (ray.flags == 0) {
          ++counts.carried;
        } else {
          ++(isOccluded ? counts.occluded : counts.lost);
          if (isDrawn)
            lines.push_back({position, position + stroke * normal, isOccluded ? kOccludedColor : kLostColor});
        }
      });
  return lines;
}

std::vector<SceneLine> latticeLines(std::span<const Lattice> lattices, LatticeKind kind) {
  constexpr vec3 kColors[]{{0.4f, 0.85f, 1}, {0.6f, 1, 0.55f}, {1, 0.6f, 0.9f}};
  std::vector<SceneLine> lines;
  for (const Lattice& lattice : lattices) {
    if (lattice.kind != kind) continue;
    const uvec3 cells = glm::clamp(lattice.cells, uvec3(1), uvec3(kMostCellsAcross));
    for (int along = 0; along < 3; ++along) {
      if (lattice.edges[static_cast<std::size_t>(along)] == vec3(0)) continue;
      const int a = (along + 1) % 3, b = (along + 2) % 3;
      const vec3 edgeA = lattice.edges[static_cast<std::size_t>(a)],
                 edgeB = lattice.edges[static_cast<std::size_t>(b)];
      const uint32_t countA = edgeA == vec3(0) ? 0 : cells[a], countB = edgeB == vec3(0) ? 0 : cells[b];
      for (uint32_t i = 0; i <= countA; ++i)
        for (uint32_t j = 0; j <= countB; ++j) {
          // Inside of a box its cells would hide each other: its faces tell them.
          if (countA > 0 && countB > 0 && i > 0 && i < countA && j > 0 && j < countB) continue;
          const vec3 from = lattice.corner + (countA > 0 ? float(i) / float(countA) : 0.0f) * edgeA +
                            (countB > 0 ? float(j) / float(countB) : 0.0f) * edgeB;
          lines.push_back({from, from + lattice.edges[static_cast<std::size_t>(along)],
                           kColors[static_cast<std::size_t>(kind)]});
        }
    }
  }
  return lines;
}

}  // namespace nephroid
