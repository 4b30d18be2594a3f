#include "beams/source_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "beams/incident_flux.h"
#include "beams/ray_mesh/caster_light.h"
#include "lights/emitters.h"
#include "scene/framing.h"
#include "transport/queries.h"

namespace nephroid {
namespace {

constexpr std::size_t kMostEmitters = 4;
constexpr std::size_t kMostTriangles = 10000;  // of a caster
constexpr double kNotableError = 0.1;

using Rays = std::vector<OutgoingRay>;

bool areOneWay(const Rays& rays, const uvec3& t) {
  const OutgoingRay &a = rays[t.x], &b = rays[t.y], &c = rays[t.z];
  return (a.flags | b.flags | c.flags) == 0 && a.signature == b.signature && a.signature == c.signature;
}

// m2 between three rays, each as far along its way as `reach` of the corner says.
float areaBetween(const Rays& rays, const uvec3& t, vec3 reach) {
  vec3 corner[3];
  for (int k = 0; k < 3; ++k) corner[k] = rays[t[k]].position + reach[k] * rays[t[k]].direction;
  return 0.5f * length(cross(corner[1] - corner[0], corner[2] - corner[0]));
}

struct Sum {
  double flux = 0, wrong = 0;
};

// Of the density of light between rays that all go one way, 0..1.
double densityError(const Rays& looked, const Rays& traced, const uvec3& t, float farthest) {
  if (!areOneWay(traced, t)) return 0;
  vec3 reach;
  for (int k = 0; k < 3; ++k) reach[k] = std::min(traced[t[k]].reach, farthest);
  const double a = double(areaBetween(looked, t, reach)), b = double(areaBetween(traced, t, reach));
  return a + b > 0 ? std::abs(a - b) / std::max(a, b) : 0;
}

// What one emitter sends through one caster, in one band.
class Comparison {
 public:
  Comparison(const Scene& scene, const RayScene& rays, const TransportSource& source,
             const TracedSource& tracedSource, const BandQuery& band)
      : scene_(scene),
        rays_(rays),
        tracedSource_(tracedSource),
        band_(band),
        object_(scene.objects[band.query.object]),
        mesh_(scene.meshOf(object_)),
        light_(shapedLight(scene, scene.lights[band.query.emitter.light])),
        looked_(mesh_.positions.size()),
        traced_(mesh_.positions.size()) {
    source.vertexRays(band.query, looked_);
    tracedSource.vertexRays(band.query, traced_);
  }

  void addTo(Sum& sum) const {
    const float farthest = 2 * worldBounds(scene_, object_).diagonal();
    const std::size_t step = 1 + mesh_.triangles.size() / kMostTriangles;
    for (std::size_t i = 0; i < mesh_.triangles.size(); i += step) {
      const uvec3& t = mesh_.triangles[i];
      const double flux = fluxOf(t);
      if (!(flux > 0)) continue;
      const double arriving = partArriving(uint32_t(i));
      if (areOneWay(looked_, t)) {
        sum.flux += flux;
        sum.wrong += flux * (1 - arriving + arriving * densityError(looked_, traced_, t, farthest));
      } else {
        sum.flux += flux * arriving;
        sum.wrong += flux * arriving;
      }
    }
  }

 private:
  double fluxOf(const uvec3& t) const {
    vec3 corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = object_.placement.point(mesh_.positions[t[k]]);
    const vec3 onto =
        band_.bandColor * fluxOnto(light_, band_.query.emitter, corner[0], corner[1], corner[2]);
    return double(onto.x + onto.y + onto.z);
  }

  // Of the light onto a triangle, by rays from the middles of its four parts.
  double partArriving(uint32_t triangle) const {
    double part = 0;
    for (const vec2 weights :
         {vec2(1 / 3.0f), vec2(1 / 6.0f), vec2(2 / 3.0f, 1 / 6.0f), vec2(1 / 6.0f, 2 / 3.0f)}) {
      const EntryPoint at = entryPoint(scene_, rays_, band_.query.object, triangle, weights);
      const SurfacePoint point{at.position, at.flatPosition, at.normal, at.geometricNormal, at.patch};
      if (tracedSource_.rayAt(band_.query, point).flags == 0) part += 0.25;
    }
    return part;
  }

  const Scene& scene_;
  const RayScene& rays_;
  const TracedSource& tracedSource_;
  const BandQuery& band_;
  const Object& object_;
  const Mesh& mesh_;
  const ShapedLight light_;
  Rays looked_, traced_;
};

}  // namespace

double sourceError(const Scene& scene, const RayScene& rays, const TransportSource& source,
                   const TracedSource& traced, Paths paths) {
  const std::vector<Emitter> emitters = emittersOf(scene);
  const std::size_t step = (emitters.size() + kMostEmitters - 1) / kMostEmitters;
  Sum sum;
  for (std::size_t i = 0; i < emitters.size(); i += step)
    for (uint32_t object = 0; object < scene.objects.size(); ++object) {
      if (!scene.isCaster(scene.objects[object])) continue;
      for (const BandQuery& band :
           queriesFor(scene, object, emitters[i], traced.mediaAround(emitters[i]), paths))
        if (band.query.reflections == 0 && !source.refines(band.query))
          Comparison(scene, rays, source, traced, band).addTo(sum);
    }
  return sum.flux > 0 ? sum.wrong / sum.flux : 0;
}

std::optional<std::string> sourceErrorNote(const Scene& scene, const RayScene& rays,
                                           const TransportSource& source, const TracedSource& traced,
                                           Paths paths) {
  const double error = sourceError(scene, rays, source, traced, paths);
  if (error <= kNotableError) return std::nullopt;
  return "the light from the table is off by about " + std::to_string(std::lround(100 * error)) +
         " %: the table has too few directions (--directions), or the mesh too few vertices; --source traced "
         "follows the light itself";
}

}  // namespace nephroid
