#include "beams/build.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "beams/first_cuts.h"
#include "beams/incident_flux.h"
#include "geometry/bounds.h"
#include "geometry/curved_triangle.h"
#include "lights/light_in_air.h"
#include "transport/refined_triangle.h"

namespace nephroid {
namespace {

constexpr std::size_t kBlock = 64;  // triangles whose beams one task makes
// Rays of a cut triangle start this part of the way toward its middle, off edges where two surfaces meet.
constexpr float kInset = 1e-3f, kInsetOnEdges = 5e-3f;

struct Corner {
  vec3 weights{0};          // barycentric, in the mesh's triangle
  vec3 position{0};         // m, on the surface
  uint32_t vertex = kNone;  // of the mesh; none where a triangle was cut
  OutgoingRay ray{};
};
using Triangle = std::array<Corner, 3>;

// The rays at the mesh's vertices.
struct VertexRays {
  const Mesh& mesh;
  const Placement& placement;
  std::vector<OutgoingRay> rays;
  std::vector<uint32_t>
      steadyTriangles;  // for each vertex a triangle about it whose rays all go one way, if there is one
  bool areOnEdges;      // of facets, where a ray may go the way of the facet beside

  void findSteadyTriangles() {
    steadyTriangles.assign(rays.size(), kNone);
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const uvec3& corners = mesh.triangles[t];
      const OutgoingRay &a = rays[corners.x], &b = rays[corners.y], &c = rays[corners.z];
      if ((a.flags | b.flags | c.flags) != 0 || a.signature != b.signature || a.signature != c.signature)
        continue;
      for (int i = 0; i < 3; ++i) steadyTriangles[corners[i]] = t;
    }
  }
};

// Makes the beams of one triangle of the mesh: the rules that it is refined by.
class Builder {
 public:
  Builder(const Scene& sceneOf, const TransportSource& sourceOf, const TransportQuery& queryOf,
          const ShapedLight& lightOf, vec3 color, const BeamSettings& settingsOf,
          const CasterTriangle& surfaceOf, const VertexRays& verticesOf)
      : scene_(sceneOf),
        source_(sourceOf),
        query_(queryOf),
        light_(lightOf),
        bandColor_(color),
        settings_(settingsOf),
        surface_(surfaceOf),
        vertices_(verticesOf),
        facing_(queryOf.media.contains(queryOf.object) ? -1.0f : 1.0f) {}

  void add(Triangle triangle, uint32_t forcedCuts, BeamSet& set) const {
    const vec3 flux = incident(triangle);
    if (!(flux.x + flux.y + flux.z > 0)) return;
    set.incidentFlux += flux;
    ++set.triangles;
    if (vertices_.areOnEdges && source_.refines(query_) && !sameWay(triangle))
      for (Corner& corner : triangle)
        corner = {corner.weights, corner.position, kNone, rayWithin(triangle, corner.weights)};
    refineTriangle(*this, triangle, settings_.refineDepth, source_.refines(query_) ? forcedCuts : 0, set);
  }

  Refining judge(const Triangle& t, uint32_t cuts, BeamSet& set) const {
    if (!source_.refines(query_) || cuts == 0) {
      keep(t, set);
    } else if (isShadowEdge(t)) {
      clip(t, cuts - 1, set);
    } else if (!sameWay(t)) {
      return Refining::cut;
    } else if (arrives(t[0].ray)) {
      const bool isEven = settings_.targets.empty() || (settings_.isEvenAtSurface && leavesWhereItMeets(t));
      if (!isEven) return Refining::askMiddles;
      keep(t, set);
    }
    return Refining::done;
  }

  Corner middle(const Triangle& t, std::size_t side) const { return between(t, t[side], t[(side + 1) % 3]); }

  bool isStraight(const Triangle& t, const Triangle& middles) const {
    for (std::size_t i = 0; i < 3; ++i)
      if (!arrives(middles[i].ray) || middles[i].ray.signature != t[0].ray.signature ||
          bends(t[i], t[(i + 1) % 3], middles[i]))
        return false;
    return true;
  }

  void countCut(BeamSet& set) const { ++set.refined; }

  void keep(const Triangle& t, BeamSet& set) const {
    const vec3 flux = incident(t);
    if (sameWay(t)) {
      if (!arrives(t[0].ray)) return;
      Beam beam{};
      for (int i = 0; i < 3; ++i) {
        beam.position[i] = t[i].ray.position;
        beam.direction[i] = t[i].ray.direction;
        beam.flux += flux * t[i].ray.transmittance / 3.0f;
        beam.reach[i] = t[i].ray.reach;
      }
      set.beams.push_back(beam);
      return;
    }
    ++set.split;
    for (int i = 0; i < 3; ++i)
      if (arrives(t[i].ray)) emitThird(t, i, flux * t[i].ray.transmittance / 3.0f, set);
  }

 private:
  vec3 incident(const Triangle& t) const {
    const vec3 middle = (t[0].position + t[1].position + t[2].position) / 3.0f;
    return bandColor_ * airTransmittance(scene_, query_.emitter, middle) *
           glm::max(facing_ * fluxOnto(light_, query_.emitter, t[0].position, t[1].position, t[2].position),
                    vec3(0));
  }

  bool arrives(const OutgoingRay& ray) const {
    if (ray.flags != 0) return false;
    if (!settings_.stopAtSurfaces) return true;
    vec2 texel;
    float distance;
    return meetPlane(ray.position, ray.direction, settings_.targets[0].plane, texel, distance) &&
           ray.reach >= distance * (1 - 1e-3f) - 1e-4f;
  }

  bool sameWay(const Triangle& t) const {
    const bool arrivesA = arrives(t[0].ray);
    return arrivesA == arrives(t[1].ray) && arrivesA == arrives(t[2].ray) &&
           (!arrivesA ||
            (t[0].ray.signature == t[1].ray.signature && t[0].ray.signature == t[2].ray.signature));
  }

  static bool leavesWhereItMeets(const Triangle& t) {
    const float tolerance = 0.01f * distance(t[0].position, t[1].position);
    return std::ranges::all_of(
        t, [&](const Corner& corner) { return distance(corner.ray.position, corner.position) < tolerance; });
  }

  Corner between(const Triangle& t, const Corner& a, const Corner& b) const {
    Corner middle;
    middle.weights = 0.5f * (a.weights + b.weights);
    middle.position = surface_.at(middle.weights).position;
    middle.ray = rayWithin(t, middle.weights);
    return middle;
  }

  OutgoingRay rayWithin(const Triangle& t, vec3 weights) const {
    const float inset = vertices_.areOnEdges ? kInsetOnEdges : kInset;
    return source_.rayAt(query_, surface_.at(mix(weights, middleWeights(t), inset)));
  }

  // Whether the ray at a side's middle lies off the middle of the rays at its ends by more than the
  // tolerance.
  bool bends(const Corner& a, const Corner& b, const Corner& middle) const {
    for (const auto& [target, leastApproach] : settings_.targets) {
      if (dot(middle.ray.direction, target.normal) < leastApproach) continue;
      vec2 atA, atB, atMiddle;
      float distance;
      const bool meets = meetPlane(a.ray.position, a.ray.direction, target, atA, distance);
      if (meets != meetPlane(b.ray.position, b.ray.direction, target, atB, distance)) return true;
      if (meets != meetPlane(middle.ray.position, middle.ray.direction, target, atMiddle, distance))
        return true;
      if (meets && length(atMiddle - 0.5f * (atA + atB)) > settings_.refineTolerance) return true;
    }
    return false;
  }

  static bool isDark(const Corner& corner) { return corner.ray.flags == kRayOccluded; }

  // Whether some corners are in shadow and the others go one way.
  bool isShadowEdge(const Triangle& t) const {
    const auto lit = std::ranges::find_if_not(t, isDark);
    if (lit == t.end() || std::ranges::none_of(t, isDark)) return false;
    return std::ranges::all_of(t, [&](const Corner& corner) {
      return isDark(corner) || (arrives(corner.ray) && corner.ray.signature == lit->ray.signature);
    });
  }

  // Goes on with the lit part of a triangle, which a straight line parts from the dark one.
  void clip(const Triangle& t, uint32_t cuts, BeamSet& set) const {
    ++set.refined;
    std::size_t first = 0;  // the corner that is alone, in the light or in the dark
    while (isDark(t[first]) == isDark(t[(first + 1) % 3]) || isDark(t[first]) == isDark(t[(first + 2) % 3]))
      ++first;
    const Corner &alone = t[first], &next = t[(first + 1) % 3], &last = t[(first + 2) % 3];
    if (isDark(alone)) {
      const Corner towardNext = edgeOfShadow(t, next, alone), towardLast = edgeOfShadow(t, last, alone);
      refineTriangle(*this, Triangle{towardNext, next, last}, cuts, 0, set);
      refineTriangle(*this, Triangle{towardNext, last, towardLast}, cuts, 0, set);
    } else {
      refineTriangle(*this, Triangle{alone, edgeOfShadow(t, alone, next), edgeOfShadow(t, alone, last)}, cuts,
                     0, set);
    }
  }

  Corner edgeOfShadow(const Triangle& t, Corner lit, Corner dark) const {
    constexpr int kHalvings = 5;
    const uint32_t signature = lit.ray.signature;
    for (int i = 0; i < kHalvings; ++i) {
      const Corner middle = between(t, lit, dark);
      (arrives(middle.ray) && middle.ray.signature == signature ? lit : dark) = middle;
    }
    // Somewhere between the two: parallel to the last ray that was lit.
    Corner edge{0.5f * (lit.weights + dark.weights), 0.5f * (lit.position + dark.position), kNone, lit.ray};
    edge.ray.position += edge.position - lit.position;
    return edge;
  }

  // The part of a triangle nearest to one of its corners goes the corner's way.
  void emitThird(const Triangle& t, int corner, vec3 flux, BeamSet& set) const {
    const vec3 own = t[corner].weights, next = t[(corner + 1) % 3].weights,
               last = t[(corner + 2) % 3].weights;
    const std::array<vec3, 4> outline{own, 0.5f * (own + next), (own + next + last) / 3.0f,
                                      0.5f * (own + last)};
    for (const auto& part : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
      Beam beam{};
      for (int i = 0; i < 3; ++i) {
        const OutgoingRay ray = rayNear(t[corner], surface_.positions * outline[part[i]]);
        beam.position[i] = ray.position;
        beam.direction[i] = ray.direction;
      }
      beam.flux = 0.5f * flux;
      beam.reach = vec3(t[corner].ray.reach);
      set.beams.push_back(beam);
    }
  }

  // The ray at a point next to a corner whose way it goes: as a steady triangle of the mesh at the corner
  // continues, or else parallel to the corner's own, so that light is as dense as it came in, and no point
  // glares.
  OutgoingRay rayNear(const Corner& corner, vec3 point) const {
    OutgoingRay ray = corner.ray;
    const uint32_t steady = corner.vertex == kNone ? kNone : vertices_.steadyTriangles[corner.vertex];
    if (steady == kNone) {
      ray.position += point - corner.position;
      return ray;
    }
    const uvec3 at = vertices_.mesh.triangles[steady];
    mat3 positions, origins, directions;
    for (int i = 0; i < 3; ++i) {
      positions[i] = vertices_.placement.point(vertices_.mesh.positions[at[i]]);
      origins[i] = vertices_.rays[at[i]].position;
      directions[i] = vertices_.rays[at[i]].direction;
    }
    const vec3 weights = barycentricOf(point, positions);
    ray.position = origins * weights;
    ray.direction = normalize(directions * weights);
    return ray;
  }

  const Scene& scene_;
  const TransportSource& source_;
  const TransportQuery& query_;
  const ShapedLight& light_;
  const vec3 bandColor_;
  const BeamSettings& settings_;
  const CasterTriangle& surface_;
  const VertexRays& vertices_;
  const float facing_;  // -1 where the light stands inside the caster and meets its triangles from behind
};

CasterTriangle casterTriangle(const Object& object, const Mesh& mesh, const uvec3& triangle) {
  mat3 positions, normals;
  for (int i = 0; i < 3; ++i) {
    positions[i] = object.placement.point(mesh.positions[triangle[i]]);
    normals[i] = object.placement.direction(mesh.normals[triangle[i]]);
  }
  return {positions, normals, mesh.isCurved};
}

// Whether the cell of water that a triangle is half of has more corners in shadow than the tolerance lets
// pass.
bool isLostToShadow(const Water& water, const VertexRays& vertices, std::size_t triangle, float tolerance) {
  if (water.grid.x == 0) return false;
  const std::size_t first = triangle & ~std::size_t{1};
  const uvec3 &even = vertices.mesh.triangles[first], &odd = vertices.mesh.triangles[first + 1];
  float dark = 0;
  for (const uint32_t vertex : {even.x, even.y, even.z, odd.z})
    if (vertices.rays[vertex].flags & kRayOccluded) ++dark;
  return dark > 4 * tolerance;
}

}  // namespace

BeamSet buildBeams(const Scene& scene, const TransportSource& source, const TransportQuery& query,
                   vec3 bandColor, const BeamSettings& settings) {
  const Object& object = scene.objects[query.object];
  const Mesh& mesh = scene.meshOf(object);
  VertexRays vertices{
      mesh, object.placement, std::vector<OutgoingRay>(mesh.positions.size()), {}, mesh.hasEdges()};
  source.vertexRays(query, vertices.rays);
  vertices.findSteadyTriangles();

  const ShapedLight light = shapedLight(scene, scene.lights[query.emitter.light]);
  const float extent = boundingBox(mesh).diagonal();
  const std::size_t blocks = (mesh.triangles.size() + kBlock - 1) / kBlock;
  std::vector<BeamSet> parts(blocks);
  oneapi::tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
    const std::size_t end = std::min(mesh.triangles.size(), (block + 1) * kBlock);
    for (std::size_t t = block * kBlock; t < end; ++t) {
      if (object.water && isLostToShadow(*object.water, vertices, t, settings.shadowTolerance)) continue;
      const CasterTriangle surface = casterTriangle(object, mesh, mesh.triangles[t]);
      Triangle triangle;
      for (int i = 0; i < 3; ++i) {
        const uint32_t vertex = mesh.triangles[t][i];
        triangle[i] = {mat3(1)[i], surface.positions[i], vertex, vertices.rays[vertex]};
      }
      Builder(scene, source, query, light, bandColor, settings, surface, vertices)
          .add(triangle, firstCutsFor(mesh, mesh.triangles[t], extent), parts[block]);
    }
  });

  BeamSet whole;
  for (BeamSet& part : parts) {
    whole.beams.insert(whole.beams.end(), part.beams.begin(), part.beams.end());
    whole.incidentFlux += part.incidentFlux;
    whole.triangles += part.triangles;
    whole.refined += part.refined;
    whole.split += part.split;
  }
  return whole;
}

}  // namespace nephroid
