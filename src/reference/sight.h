// What is seen along a line of sight, through and in casters, and in what it goes through on the way.
#pragma once

#include "reference/direct.h"
#include "reference/photon_map.h"
#include "reference/sampling.h"

namespace nephroid {

// nit, by where the light had been: direct met no caster, caustics at least one, shafts was scattered in the
// air or in a caster's volume; rest is the background, what shines by itself and what is reflected of ambient
// light.
struct Seen {
  vec3 direct{0};
  vec3 caustics{0};
  vec3 shafts{0};
  vec3 rest{0};
};

// The light of one pass.
struct PassLight {
  std::vector<Band> bands;
  PhotonMap onSurfaces;
  PhotonMap inVolumes;
  float surfaceRadius = 0;  // part of the distance travelled, around a place that is seen
  float volumeRadius = 0;
  float largestRadius = 0;  // m
  bool isSplatted = false;  // where it is seen directly, and is not to be gathered there
};

class Sight {
 public:
  // All must outlive this.
  Sight(const Scene& scene, const Boundaries& boundaries, const Lights& lights);

  // Along a ray from `media`; a sample of it.
  Seen look(const Ray& ray, const MediumStack& media, const PassLight& light, Random& random) const;

 private:
  // A line of sight on its way.
  struct View {
    Path path;
    Ray ray;
    float travelled = 0;  // m before the ray's origin
    uint32_t band = 0;
    vec3 weight(const PassLight& light) const;
  };

  void lookAtReceiver(const View& view, const Hit& hit, const PassLight& light, Random& random,
                      Seen& seen) const;
  vec3 gather(const View& view, const Hit& hit, vec3 normal, const PassLight& light) const;
  vec3 scattered(const View& view, float length, const PassLight& light, Random& random) const;
  vec3 scatteredFromLight(const View& view, float length, uint32_t source, Random& random) const;
  vec3 scatteredFromCasters(const View& view, float length, const PassLight& light, Random& random) const;

  const Scene& scene;
  const Boundaries& boundaries;
  const Lights& lights;
};

// Reflectance of a diffuse surface where it was hit, its texture included.
vec3 diffuseReflectance(const Scene& scene, const Hit& hit);

}  // namespace nephroid
