// Follows view rays through and into casters, and computes the luminance that they see.
#pragma once

#include "reference/direct.h"
#include "reference/photon_map.h"
#include "reference/sampling.h"

namespace nephroid {

// Luminance (nit), divided by the path of the light. direct: met no caster. caustics: met a caster. shafts:
// was scattered in the air or inside a caster. rest: background, emission of surfaces, and reflected ambient
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
  float surfaceRadius = 0;  // radius of the search, per m that the view ray has traveled
  float volumeRadius = 0;
  float largestRadius = 0;  // m
  bool isSplatted = false;  // light that is seen directly was splatted, so it must not be gathered again
};

class Sight {
 public:
  // All must outlive this.
  Sight(const Scene& scene, const Boundaries& boundaries, const Lights& lights);

  // A sample of the luminance along a ray that begins inside `media`.
  Seen look(const Ray& ray, const MediumStack& media, const PassLight& light, Random& random) const;

 private:
  // The state of a view ray.
  struct View {
    Path path;
    Ray ray;
    float traveled = 0;  // m before the ray's origin
    uint32_t band = 0;
    vec3 weight(const PassLight& light) const;
  };

  void lookAtReceiver(const View& view, const Hit& hit, const PassLight& light, Random& random,
                      Seen& seen) const;
  vec3 gather(const View& view, const Hit& hit, vec3 normal, const PassLight& light) const;
  vec3 scattered(const View& view, float length, const PassLight& light, Random& random) const;
  vec3 scatteredFromLight(const View& view, float length, uint32_t source, Random& random) const;
  vec3 scatteredFromCasters(const View& view, float length, const PassLight& light, Random& random) const;

  const Scene& scene_;
  const Boundaries& boundaries_;
  const Lights& lights_;
};

}  // namespace nephroid
