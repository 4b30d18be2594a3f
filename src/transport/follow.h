// Light followed through everything transparent or mirroring until it meets something opaque or nothing.
#pragma once

#include <vector>

#include "trace/ray_scene.h"
#include "transport/outgoing_ray.h"
#include "transport/source.h"

namespace nephroid {

// Boundaries a ray may cross before it is given up as trapped.
inline constexpr uint32_t kMaximumCrossings = 48;

struct FollowSettings {
  uint32_t channel = 0;
  Paths paths = Paths::transmission;
  uint32_t reflections = 0;  // as TransportQuery
  // As TransportQuery: what is followed against the light is radiance, which changes with the square of the
  // index (Veach 1997, 5.2); and it ends on a receiver, up to which it is absorbed.
  bool isSight = false;
};

class Follower {
 public:
  // One material for every object of `rays`; both must outlive this.
  Follower(const RayScene& rays, std::vector<const Material*> materials);

  // What becomes of light that travels along `direction` and meets `entry` on `object`, in the media of
  // `media`.
  OutgoingRay follow(const SurfacePoint& entry, uint32_t object, vec3 direction, MediumStack media,
                     const FollowSettings& settings) const;

  // The closed transparent objects around a point.
  MediumStack mediaAround(vec3 point) const;

  const RayScene& rayScene() const { return rays; }

 private:
  const RayScene& rays;
  std::vector<const Material*> materials;
};

}  // namespace nephroid
