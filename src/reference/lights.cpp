#include "reference/lights.h"

#include <algorithm>
#include <cmath>

#include "core/color.h"
#include "geometry/bounds.h"
#include "reference/sampling.h"

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

// 1 - cosine of the half angle that a ball is seen under; 2 from inside it.
float coneWidth(vec3 from, vec3 center, float radius) {
  const float sineSquared = radius * radius / std::max(dot(center - from, center - from), 1e-30f);
  if (!(sineSquared < 1)) return 2;
  return sineSquared / (1 + std::sqrt(1 - sineSquared));
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
      const float width = coneWidth(middleOf(light), target.center, target.radius);
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
  if (light.type == LightType::line) return glm::mix(light.position, light.end, u);
  if (light.type != LightType::area) return light.position;
  const vec2 at = pointOnCurve(double(u));
  return light.position + at.x * light.u + at.y * light.v;
}

// Of a directional light always the same.
SkyDistribution::Sample Lights::fromAfar(uint32_t index, float u) const {
  const Light& light = scene_.lights[index];
  if (light.type == LightType::directional) return {light.direction, light.illuminance};
  SkyDistribution::Sample sample = skies_[skyOfLight_[index]].sample(u);
  sample.weight *= light.intensity;
  return sample;
}

Illumination Lights::illumination(uint32_t index, vec3 point, float u) const {
  if (comesFromAfar(index)) {
    const auto [direction, lux] = fromAfar(index, u);
    return {direction, std::numeric_limits<float>::infinity(), lux};
  }
  const vec3 offset = point - position(index, u);
  const float distance = length(offset);
  const vec3 direction = offset / distance;
  return {direction, distance, lightIntensity(shapes_[index], direction) / (distance * distance)};
}

EmittedPhoton Lights::emit(double choice, float along) const {
  const auto chosen = std::upper_bound(shares_.begin(), shares_.end() - 1, choice,
                                       [](double u, const Share& share) { return u < share.cumulative; });
  const double before = chosen == shares_.begin() ? 0 : (chosen - 1)->cumulative;
  const vec2 at = pointOnCurve(std::clamp((choice - before) / chosen->probability, 0.0, 1 - 0x1p-48));
  if (comesFromAfar(chosen->light)) return emitFromAfar(*chosen, fromAfar(chosen->light, along), at);
  return emitFromPoint(*chosen, position(chosen->light, along), at);
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

EmittedPhoton Lights::emitFromPoint(const Share& share, vec3 origin, vec2 at) const {
  const Light& light = scene_.lights[share.light];
  const auto widthOf = [&](const Target& target) {
    return target.isCone ? coneWidth(light) : coneWidth(origin, target.center, target.radius);
  };
  const auto axisOf = [&](const Target& target) {
    if (target.isCone) return light.direction;
    const vec3 offset = target.center - origin;
    return dot(offset, offset) > 0 ? normalize(offset) : vec3(0, 0, 1);
  };
  const vec3 direction = normalize(frameAround(axisOf(share.target)) * sampleCone(at, widthOf(share.target)));
  float density = 0;  // 1/sr, of all the targets that it may have been meant for
  for (uint32_t i = firstShare_[share.light]; i < firstShare_[share.light + 1]; ++i) {
    const float width = widthOf(shares_[i].target);
    const vec3 aside = direction - axisOf(shares_[i].target);  // 1 - cosine is half its square
    if (&shares_[i] == &share || width >= 2 || 0.5f * dot(aside, aside) <= width)
      density += float(shares_[i].probability) * coneDensity(width);
  }
  return {origin, direction, lightIntensity(shapes_[share.light], direction) / density, share.light};
}

}  // namespace nephroid
