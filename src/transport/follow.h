// Follows light through casters until it meets an opaque surface or leaves the scene.
#pragma once

#include <vector>

#include "trace/crossing.h"
#include "trace/ray_scene.h"
#include "transport/outgoing_ray.h"
#include "transport/source.h"

namespace nephroid {

struct FollowSettings {
  uint32_t channel = 0;
  Paths paths = Paths::transmission;
  uint32_t reflections = 0;  // as TransportQuery
  // As in TransportQuery. A view ray carries radiance, which changes with the square of the index of
  // refraction (Veach 1997, 5.2). It ends on a receiver, and is absorbed up to there.
  bool isSight = false;
};

class Follower {
 public:
  // One material for every object of `rays`; both must outlive this.
  Follower(const RayScene& rays, std::vector<const Material*> materials);

  // Follows light that travels along `direction` (unit) inside `media` and meets `object` at `entry`.
  OutgoingRay follow(const SurfacePoint& entry, uint32_t object, vec3 direction, MediumStack media,
                     const FollowSettings& settings) const;

  // The closed transparent objects around a point (m).
  MediumStack mediaAround(vec3 point) const;

  const RayScene& rayScene() const { return rays_; }

 private:
  const RayScene& rays_;
  std::vector<const Material*> materials_;
};

}  // namespace nephroid
