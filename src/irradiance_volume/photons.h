// Photons of a directional light followed through one caster.
#pragma once

#include <vector>

#include "core/progress.h"
#include "irradiance_volume/symmetry.h"
#include "scene/scene.h"
#include "trace/paths.h"
#include "transport/follow.h"

namespace nephroid {

// A straight part of a photon's path through the air after it met the caster. In a light sample's frame: in
// bounding radii from the center of the bounding sphere, z along the light.
struct PhotonPath {
  vec3 origin{0};
  vec3 direction{0};  // unit
  vec3 flux{0};       // for light of 1 lux, by channel: lux times square bounding radii
  float length = 0;   // bounding radii
};

// The flux of a path, as the mean of the channels.
inline float brightness(const PhotonPath& path) {
  return (path.flux.x + path.flux.y + path.flux.z) / 3;
}

// How photons of two light directions are paired.
enum class PairedBy {
  place,
  entry
};  // by the same place on the disk of light; by the same point where they meet the caster

// The paths of a pair of photons, each in the frame of its light.
struct PhotonPair {
  PhotonPath from;
  PhotonPath to;
};

// One caster in its own space, ready to have photons sent through it.
class CasterTracer {
 public:
  // Mesh and material must outlive this. Attenuation distances are in the mesh's own units.
  CasterTracer(const Mesh& mesh, const Material& material, Paths paths);

  // Traces `photons` photons, spread evenly over the disk of the bounding sphere, for light of 1 lux along
  // `lightDirection` (unit). Photons that meet nothing have no paths. Paths end `reach` bounding radii from
  // the center. Paths and their order do not depend on the number of threads.
  std::vector<PhotonPath> trace(vec3 lightDirection, uint32_t photons, float reach) const;
  // The same for the light's frame: its direction is frame[2].
  std::vector<PhotonPath> trace(const mat3& frame, uint32_t photons, float reach) const;

  // Traces photons for the lights of two frames, and returns those that form pairs.
  std::vector<PhotonPair> pairs(const mat3& frame, const mat3& other, PairedBy pairedBy, uint32_t photons,
                                float reach) const;

  const Sphere& sphere() const { return sphere_; }
  const Symmetry& symmetry() const { return symmetry_; }

 private:
  std::vector<PhotonPath> send(vec3 start, const mat3& frame, vec3 flux, float reach, Hit& hit) const;
  void follow(const Hit& first, vec3 direction, vec3 flux, std::vector<PhotonPath>& paths) const;
  void reflect(Hit hit, vec3 direction, vec3 flux, std::vector<PhotonPath>& paths) const;

  const Material& material_;
  Paths paths_;
  RayScene rays_;
  Follower follower_;
  Sphere sphere_;
  Symmetry symmetry_;
};

}  // namespace nephroid
