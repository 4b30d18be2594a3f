#include "transport/follow.h"

#include <algorithm>

#include "scene/volume.h"
#include "trace/crossing.h"

namespace nephroid {
namespace {

constexpr float kFarthestSight = 1e7f;  // m in a medium, where nothing is met

enum class Event : uint32_t { entered, left, reflected };

uint32_t extendSignature(uint32_t signature, uint32_t object, uint32_t patch, Event event) {
  for (const uint32_t word : {object, patch, static_cast<uint32_t>(event)})
    signature = (signature ^ (word + 0x9e3779b9u)) * 16777619u;  // FNV-1a, a word at a time
  return signature;
}

}  // namespace

Follower::Follower(const RayScene& rayScene, std::vector<const Material*> materialOfObject)
    : rays_(rayScene), materials_(std::move(materialOfObject)) {}

namespace {

// A ray on its way: what Follower::follow changes from boundary to boundary.
struct Walk {
  OutgoingRay ray{};
  MediumStack media;
  uint32_t choices = 0;  // boundaries passed where light could both be reflected and transmitted
};

// Light that meets a dielectric boundary goes on along `walk`. False: it is lost.
bool crossDielectric(const std::vector<const Material*>& materials, const FollowSettings& settings,
                     const Hit& hit, const MediaSides& sides, Walk& walk) {
  OutgoingRay& ray = walk.ray;
  const uint32_t object = hit.object;
  const uint32_t patch = hit.patch;
  const bool entering = dot(ray.direction, hit.geometricNormal) < 0;
  walk.media = sides.before;
  const MediumStack& beyond = sides.beyond;
  if (walk.media.top() == beyond.top()) {  // inside another object, which fills this place
    walk.media = beyond;
    return true;
  }
  const float eta =
      iorOf(materials, walk.media.top(), settings.channel) / iorOf(materials, beyond.top(), settings.channel);
  const Bend bend = bendAt(ray.direction, hit.normal, hit.geometricNormal, eta);
  const bool canTransmit = bend.reflectance < 1;
  if (!canTransmit && settings.paths == Paths::transmission) return false;
  const bool planned = canTransmit && ((settings.reflections >> walk.choices) & 1u);
  if (canTransmit) ++walk.choices;
  if (planned || !canTransmit) {
    ray.direction = bend.reflected;
    ray.transmittance *= bend.reflectance;
    ray.signature = extendSignature(ray.signature, object, patch, Event::reflected);
    return true;
  }
  ray.direction = bend.transmitted;
  ray.transmittance *= (1 - bend.reflectance) * (settings.isSight ? eta * eta : 1.0f);
  ray.signature = extendSignature(ray.signature, object, patch, entering ? Event::entered : Event::left);
  walk.media = beyond;
  return true;
}

// A sheet too thin to bend light: what both its faces let through, multiple reflections between them
// included.
void crossThinWall(const Material& material, const FollowSettings& settings, uint32_t object, uint32_t patch,
                   vec3 normal, Walk& walk) {
  walk.ray.transmittance *= thinWallTransmittance(material, settings.channel, walk.ray.direction, normal);
  walk.ray.signature = extendSignature(walk.ray.signature, object, patch, Event::entered);
}

void absorb(const std::vector<const Material*>& materials, float length, Walk& walk) {
  const uint32_t medium = walk.media.top();
  if (medium == kNone) return;
  walk.ray.pathLength += length;
  walk.ray.transmittance *= transmittanceOf(*materials[medium], length);
}

}  // namespace

OutgoingRay Follower::follow(const SurfacePoint& entry, uint32_t object, vec3 direction, MediumStack media,
                             const FollowSettings& settings) const {
  Walk walk;
  walk.media = media;
  OutgoingRay& ray = walk.ray;
  ray.position = entry.position;
  ray.direction = direction;
  ray.transmittance = vec3(1);
  ray.signature = 2166136261u;
  ray.reach = kUnboundedReach;

  Hit hit;
  hit.object = object;
  hit.patch = entry.patch;
  hit.position = entry.position;
  hit.flatPosition = entry.flatPosition;
  hit.normal = entry.normal;
  hit.geometricNormal = entry.geometricNormal;
  for (uint32_t crossing = 0; crossing < kMaximumCrossings; ++crossing) {
    const Material& material = *materials_[hit.object];
    ray.position = hit.position;
    if (material.type == MaterialType::mirror) {
      ray.direction = reflectedBy(ray.direction, hit.normal, hit.geometricNormal).direction;
      ray.transmittance *= material.color;
      ray.signature = extendSignature(ray.signature, hit.object, hit.patch, Event::reflected);
    } else if (material.thinWalled) {
      const vec3 normal = facingNormal(ray.direction, hit.normal, hit.geometricNormal);
      crossThinWall(material, settings, hit.object, hit.patch, normal, walk);
    } else if (!crossDielectric(materials_, settings, hit, sidesOf(rays_, walk.media, hit, ray.direction),
                                walk)) {
      ray.flags |= kRayLost;
      return ray;
    }
    const bool goesOn = rays_.intersect(rays_.leaving(hit, ray.direction), hit);
    if (goesOn && materials_[hit.object]->isCaster()) {
      absorb(materials_, hit.distance, walk);
      continue;
    }
    if (goesOn) ray.reach = hit.distance;
    if (settings.isSight) absorb(materials_, goesOn ? hit.distance : kFarthestSight, walk);
    const bool leaked = !goesOn && walk.media.top() != kNone && rays_.isClosed(walk.media.top());
    const bool planUnfulfilled = (settings.reflections >> walk.choices) != 0;
    if (leaked || planUnfulfilled) ray.flags |= kRayLost;
    return ray;
  }
  ray.flags |= kRayLost;
  return ray;
}

MediumStack Follower::mediaAround(vec3 point) const {
  return nephroid::mediaAround(rays_, materials_, point);
}

}  // namespace nephroid
