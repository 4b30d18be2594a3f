// Follows view rays through and into casters, and computes the luminance that they see.
#pragma once

#include "lights/seen_skies.h"
#include "reference/direct.h"
#include "reference/draws.h"
#include "reference/photon_map.h"

namespace nephroid {

// Luminance (nit), divided by the path of the light. direct: met no caster. caustics: met a caster. shafts:
// was scattered in the air or inside a caster. rest: background, skies, emission of surfaces, and reflected
// ambient light.
struct Seen {
  vec3 direct{0};
  vec3 caustics{0};
  vec3 shafts{0};
  vec3 rest{0};
};

// What photons add to the picture, of each of some equal parts of a pass.
struct PhotonWorths {
  std::vector<double> squares;  // sums of the squares of luminances (nit)
  uint32_t photonsInPart = 1;
  void add(uint32_t photon, float luminance) {
    squares[photon / photonsInPart] += double(luminance) * double(luminance);
  }
};

// The light of one pass, or of a part of one.
struct PassLight {
  std::vector<Band> bands;
  PhotonMap onSurfaces;
  PhotonMap inVolumes;
  float surfaceRadius = 0;  // radius of the search, per m that the view ray has traveled
  float volumeRadius = 0;
  float largestRadius = 0;  // m
  bool isSplatted = false;  // light that is seen directly was splatted, so it must not be gathered again
  PhotonWorths* worths = nullptr;  // to be added to, in one thread
};

class Sight {
 public:
  // All must outlive this.
  Sight(const Scene& scene, const Boundaries& boundaries, const Lights& lights);

  // A sample of the luminance along a ray that begins inside `media`. At the first few surfaces of glass the
  // view goes on by both ways, reflected and transmitted, where each is worth it; further on by one of them,
  // with the probability of its part.
  Seen look(const Ray& ray, const MediumStack& media, const PassLight& light, Draws& draws) const;

 private:
  // The state of a view ray.
  struct View {
    Path path;
    Ray ray;
    float traveled = 0;  // m before the ray's origin
    uint32_t band = 0;
    uint32_t encounters = 0;
    uint32_t splits = 0;  // surfaces from which it went on by both ways
    vec3 weight(const PassLight& light) const;
  };

  void follow(View view, const PassLight& light, Draws& draws, Seen& seen) const;
  bool splits(const Hit& hit, const PassLight& light, View& view, View& reflected) const;
  bool goOn(const Hit& hit, const PassLight& light, Choice choice, float u, View& view) const;
  void lookAtReceiver(const View& view, const Hit& hit, const PassLight& light, Draws& draws,
                      Seen& seen) const;
  vec3 gather(const View& view, const Hit& hit, const LitPoint& point, vec3 reflected,
              const PassLight& light) const;
  vec3 scattered(const View& view, float length, const PassLight& light, Draws& draws) const;
  vec3 scatteredFromLight(const View& view, float length, uint32_t source, Draws& draws) const;
  vec3 scatteredFromCasters(const View& view, float length, const PassLight& light, Draws& draws) const;

  const Scene& scene_;
  const Boundaries& boundaries_;
  const Lights& lights_;
  SeenSkies skies_;
};

}  // namespace nephroid
