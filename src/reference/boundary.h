// What becomes of light, or of a line of sight, where it meets a caster.
#pragma once

#include "core/random.h"
#include "reference/spectrum.h"
#include "trace/media.h"

namespace nephroid {

// flux: photons on their way from a light. radiance: a line of sight, followed against the light; radiance
// grows by the square of the index it enters (Veach 1997, 5.2), flux does not.
enum class Carried { flux, radiance };

// A photon or a line of sight between two surfaces.
struct Path {
  vec3 direction{0};   // unit
  vec3 throughput{1};  // what is left of it, without the weight of its band
  MediumStack media;   // what it is inside of
  bool metCaster = false;
  bool isDispersed = false;  // its band's weight counts
};

// Which way a path goes from glass, where it may go two: either, as often as light does; or one of them, with
// the share of light that goes there as its weight.
enum class Choice { random, reflected, transmitted };

class Boundaries {
 public:
  // Both must outlive this.
  Boundaries(const Scene& scene, const RayScene& rays);

  // Sends a path on from a caster. False: it is lost, or is to be transmitted and totally reflected.
  bool send(const Hit& hit, const Band& band, Carried carried, Choice choice, Random& random,
            Path& path) const;

  // The part of light that a length (m, may be infinite) of an object's material, or of the air for kNone,
  // lets through along unit `direction`.
  vec3 transmittance(uint32_t object, vec3 from, vec3 direction, float length) const;

  // How an object's material, or the air, scatters: 1/m at a point, and 1/sr by the cosine between the ways
  // light travels before and after.
  bool isScattering(uint32_t object) const;
  vec3 scattering(uint32_t object, vec3 point) const;
  float phase(uint32_t object, float cosine) const;
  // 1/m, of the channels; of the air where it is densest.
  float meanExtinction(uint32_t object) const;

  bool isCaster(const Hit& hit) const { return materials[hit.object]->isCaster(); }
  const Material& materialOf(const Hit& hit) const { return *materials[hit.object]; }
  MediumStack mediaAround(vec3 point) const;
  const RayScene& rayScene() const { return rays; }

 private:
  bool crossDielectric(const Hit& hit, const Band& band, Carried carried, Choice choice, float u,
                       Path& path) const;
  bool crossThinWall(const Hit& hit, const Band& band, Carried carried, Choice choice, float u,
                     Path& path) const;
  bool reflect(const Hit& hit, Carried carried, Path& path) const;
  float indexIn(uint32_t object, const Band& band) const;

  const RayScene& rays;
  std::vector<const Material*> materials;  // of the objects
  std::vector<vec3> extinctions;           // of the objects
  std::vector<bool> isCurved;              // their meshes
  const std::optional<Medium>& air;
};

}  // namespace nephroid
