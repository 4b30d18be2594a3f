#include "reference/lights.h"

#include <algorithm>
#include <cmath>

#include "core/color.h"
#include "core/directions.h"
#include "geometry/bounds.h"

namespace nephroid {
namespace {

constexpr std::size_t kMostTargets = 32;  // casters that are aimed at one by one

Sphere ballAround(const Scene& scene, const Object& object) {
  const Sphere sphere = boundingSphere(scene.meshOf(object));
  return {object.placement.point(sphere.center), sphere.radius * object.placement.scale * 1.0001f};
}

Sphere ballAround(const std::vector<Sphere>& balls) {
  if (balls.empty()) return {};
  Box box;
  for (const Sphere& ball : balls) {
    box.include(ball.center - ball.radius);
    box.include(ball.center + ball.radius);
  }
  Sphere whole{box.center(), 0};
  for (const Sphere& ball : balls)
    whole.radius = std::max(whole.radius, length(ball.center - whole.center) + ball.radius);
  return whole;
}

// The place on a light for a number in [0, 1).
vec2 placeOn(const Light& light, float u) {
  return light.type == LightType::line ? vec2(u, 0) : pointOnCurve(double(u));
}

float coneWidth(const Light& light) {
  return std::max(1 - std::cos(glm::radians(light.outerAngle)), 1e-7f);
}

}  // namespace

Lights::Lights(const Scene& sceneOfLights, Aim aim) : scene_(sceneOfLights) {
  for (const Light& light : scene_.lights) {
    shapes_.push_back(shapedLight(scene_, light));
    skyOfLight_.push_back(uint32_t(skies_.size()));
    if (light.type == LightType::sky) skies_.emplace_back(scene_.skies[light.skyMap], light.skyRotation);
  }
  std::vector<Sphere> objects, casters;
  for (const Object& object : scene_.objects) {
    objects.push_back(ballAround(scene_, object));
    if (scene_.isCaster(object)) casters.push_back(objects.back());
  }
  const Sphere whole = ballAround(objects);
  sceneCenter_ = whole.center;
  sceneRadius_ = whole.radius;
  for (const Light& light : scene_.lights)
    meetsCaster_.push_back(std::ranges::any_of(casters, [&](const Sphere& ball) {
      return extentOf(light) > 0 && distance(middleOf(light), ball.center) < extentOf(light) + ball.radius;
    }));
  if (casters.size() > kMostTargets) casters = {ballAround(casters)};

  std::vector<Target> targets;
  if (aim == Aim::everywhere) {
    targets = {{sceneCenter_, std::numeric_limits<float>::infinity()}};
  } else {
    for (const Sphere& ball : casters) targets.push_back({ball.center, ball.radius});
  }
  for (uint32_t light = 0; light < scene_.lights.size(); ++light) addShares(light, targets);
  firstShare_.push_back(uint32_t(shares_.size()));

  double sum = 0;
  for (const Share& share : shares_) sum += share.probability;
  double cumulative = 0;
  for (Share& share : shares_) {
    share.probability /= sum;
    share.cumulative = cumulative += share.probability;
  }
}

// Photons by the flux each target could receive at most.
void Lights::addShares(uint32_t index, const std::vector<Target>& targets) {
  firstShare_.push_back(uint32_t(shares_.size()));
  const Light& light = scene_.lights[index];
  const bool isSpot = light.type == LightType::spot;
  float coneFlux = 0;
  for (Target target : targets) {
    float flux = 0;
    if (comesFromAfar(index)) {
      target.radius = std::min(target.radius, sceneRadius_);
      const vec3 illuminance = light.type == LightType::directional
                                   ? light.illuminance
                                   : light.intensity * skies_[skyOfLight_[index]].illuminance();
      flux = luminanceOf(illuminance) * kPi * target.radius * target.radius;
    } else {
      const float width = targetWidth(light, middleOf(light), target);
      if (isSpot && width > coneWidth(light)) {
        coneFlux = luminanceOf(peakIntensity(light)) * 2 * kPi * coneWidth(light);
        continue;
      }
      flux = luminanceOf(peakIntensity(light)) * 2 * kPi * width;
    }
    if (flux > 0) shares_.push_back({index, target, flux, 0});
  }
  if (coneFlux > 0) shares_.push_back({index, {light.position, 0, true}, coneFlux, 0});
}

uint32_t Lights::count() const {
  return uint32_t(scene_.lights.size());
}

bool Lights::comesFromAfar(uint32_t light) const {
  const LightType type = scene_.lights[light].type;
  return type == LightType::directional || type == LightType::sky;
}

vec3 Lights::position(uint32_t index, float u) const {
  const Light& light = scene_.lights[index];
  if (light.type == LightType::point || light.type == LightType::spot) return light.position;
  return lampOrigin(light, vec3(0), placeOn(light, u));
}

SkyDistribution::Sample Lights::fromAfar(uint32_t index, float u) const {
  const Light& light = scene_.lights[index];
  if (light.type == LightType::directional) {
    const LightFromAfar part = lampFromAfar(light, placeOn(light, u));
    return {part.direction, part.illuminance};
  }
  SkyDistribution::Sample sample = skies_[skyOfLight_[index]].sample(u);
  sample.weight *= light.intensity;
  return sample;
}

Illumination Lights::illumination(uint32_t index, vec3 point, float u) const {
  const Light& light = scene_.lights[index];
  if (light.type != LightType::sky) return lampLight(light, shapes_[index], point, placeOn(light, u));
  const auto [direction, lux] = fromAfar(index, u);
  return {direction, std::numeric_limits<float>::infinity(), lux};
}

EmittedPhoton Lights::emit(double choice, float along) const {
  const auto chosen = std::upper_bound(shares_.begin(), shares_.end() - 1, choice,
                                       [](double u, const Share& share) { return u < share.cumulative; });
  const double before = chosen == shares_.begin() ? 0 : (chosen - 1)->cumulative;
  const vec2 at = pointOnCurve(std::clamp((choice - before) / chosen->probability, 0.0, 1 - 0x1p-48));
  if (comesFromAfar(chosen->light)) return emitFromAfar(*chosen, fromAfar(chosen->light, along), at);
  return emitFromNear(*chosen, placeOn(scene_.lights[chosen->light], along), at);
}

EmittedPhoton Lights::emitFromAfar(const Share& share, const SkyDistribution::Sample& light, vec2 at) const {
  const mat3 frame = frameAround(light.direction);
  const vec2 disk = share.target.radius * sampleDisk(at);
  const vec3 through = share.target.center + frame[0] * disk.x + frame[1] * disk.y;
  float density = 0;  // 1/m2, of all the targets that it may have been meant for
  for (uint32_t i = firstShare_[share.light]; i < firstShare_[share.light + 1]; ++i) {
    const Target& target = shares_[i].target;
    const vec3 offset = through - target.center;
    const vec3 aside = offset - dot(offset, light.direction) * light.direction;
    const float radiusSquared = target.radius * target.radius;
    if (&shares_[i] == &share || dot(aside, aside) <= radiusSquared)
      density += float(shares_[i].probability) / (kPi * radiusSquared);
  }
  const float back = dot(through - sceneCenter_, light.direction) + 1.01f * sceneRadius_;
  return {through - back * light.direction, light.direction, light.weight / density, share.light};
}

// 1 - cosine of the half angle of the directions toward a target. From a ball, light of one direction sets
// out all over its disk: a target is as much larger.
float Lights::targetWidth(const Light& light, vec3 origin, const Target& target) const {
  const bool isBall = light.type == LightType::point || light.type == LightType::spot;
  return target.isCone ? coneWidth(light)
                       : coneWidth(origin, target.center, target.radius + (isBall ? light.radius : 0.0f));
}

// `place`: on the light.
EmittedPhoton Lights::emitFromNear(const Share& share, vec2 place, vec2 at) const {
  const Light& light = scene_.lights[share.light];
  const bool isBall = light.type == LightType::point || light.type == LightType::spot;
  const vec3 origin = isBall ? light.position : lampOrigin(light, vec3(0), place);
  const auto axisOf = [&](const Target& target) {
    if (target.isCone) return light.direction;
    const vec3 offset = target.center - origin;
    return dot(offset, offset) > 0 ? normalize(offset) : vec3(0, 0, 1);
  };
  const vec3 direction =
      normalize(frameAround(axisOf(share.target)) * sampleCone(at, targetWidth(light, origin, share.target)));
  float density = 0;  // 1/sr, of all the targets that it may have been meant for
  for (uint32_t i = firstShare_[share.light]; i < firstShare_[share.light + 1]; ++i) {
    const float width = targetWidth(light, origin, shares_[i].target);
    const vec3 aside = direction - axisOf(shares_[i].target);  // 1 - cosine is half its square
    if (&shares_[i] == &share || width >= 2 || 0.5f * dot(aside, aside) <= width)
      density += float(shares_[i].probability) * coneDensity(width);
  }
  return {isBall ? lampOrigin(light, direction, place) : origin, direction,
          lightIntensity(shapes_[share.light], direction) / density, share.light};
}

}  // namespace nephroid
