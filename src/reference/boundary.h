// What happens to light, or to a view ray, at the surface of a caster.
#pragma once

#include "reference/spectrum.h"
#include "trace/media.h"

namespace nephroid {

// What a path carries. flux: photons from a light. radiance: a view ray, followed against the light. At a
// refraction radiance changes by the square of the index of refraction (Veach 1997, 5.2); flux does not.
enum class Carried { flux, radiance };

// The state of a photon or a view ray between two surfaces.
struct Path {
  vec3 direction{0};   // unit
  vec3 throughput{1};  // the part that is left per channel, without the weight of its band
  MediumStack media;   // the objects that it is inside of
  bool metCaster = false;
  bool isDispersed = false;  // it was dispersed, so that the weight of its band counts
};

// The choice between reflection and transmission at glass. random: with the probability of each part of the
// light. reflected, transmitted: always this one, with its part of the light as the weight.
enum class Choice { random, reflected, transmitted };

class Boundaries {
 public:
  // Both must outlive this.
  Boundaries(const Scene& scene, const RayScene& rays);

  // Continues a path at the surface of a caster. Returns false where the path ends: its light is lost, or
  // `choice` is transmitted and all light is reflected. `u` in [0, 1): for a random choice.
  bool send(const Hit& hit, const Band& band, Carried carried, Choice choice, float u, Path& path) const;

  // The transmittance (0..1 per channel) of an object's material, or of the air for kNone, from `from` along
  // `direction` (unit). `length`: m, may be infinite.
  vec3 transmittance(uint32_t object, vec3 from, vec3 direction, float length) const;

  // Scattering of an object's material, or of the air for kNone. scattering: the coefficient (1/m) at a
  // point. phase: the phase function (1/sr) by the cosine between the directions of travel before and after.
  bool isScattering(uint32_t object) const;
  vec3 scattering(uint32_t object, vec3 point) const;
  float phase(uint32_t object, float cosine) const;
  // Extinction (1/m), the mean of the channels; for the air where it is densest.
  float meanExtinction(uint32_t object) const;

  bool isCaster(const Hit& hit) const { return materials_[hit.object]->isCaster(); }
  const Material& materialOf(const Hit& hit) const { return *materials_[hit.object]; }
  MediumStack mediaAround(vec3 point) const;
  const RayScene& rayScene() const { return rays_; }

 private:
  bool crossDielectric(const Hit& hit, const Band& band, Carried carried, Choice choice, float u,
                       Path& path) const;
  void crossThinWall(const Hit& hit, const Band& band, Choice choice, float u, Path& path) const;
  void reflect(const Hit& hit, Path& path) const;
  float indexIn(uint32_t object, const Band& band) const;

  const RayScene& rays_;
  std::vector<const Material*> materials_;  // of the objects
  std::vector<vec3> extinctions_;           // of the objects
  const std::optional<Medium>& air_;
};

}  // namespace nephroid
