#include "lights/light_intensity.h"

#include <algorithm>
#include <cmath>

#include "lights/profile_lookup.h"

namespace nephroid {
namespace {

static_assert(uint32_t(PhotometryType::c) == kProfileTypeC && uint32_t(PhotometryType::b) == kProfileTypeB &&
              uint32_t(PhotometryType::a) == kProfileTypeA);

// Integral of a function that is linear between the angles (degrees) times the sine of the angle from
// `poleAt`.
template <class Value>
double integralOverSine(const std::vector<float>& angles, double poleAt, const Value& value) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    const double low = glm::radians(angles[i] - poleAt), high = glm::radians(angles[i + 1] - poleAt);
    const double slope = (value(i + 1) - value(i)) / (high - low);
    sum +=
        value(i) * std::cos(low) - value(i + 1) * std::cos(high) + slope * (std::sin(high) - std::sin(low));
  }
  return sum;
}

// Trapezoids, in radians.
template <class Value>
double integral(const std::vector<float>& angles, const Value& value) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < angles.size(); ++i)
    sum += 0.5 * (value(i) + value(i + 1)) * glm::radians(static_cast<double>(angles[i + 1] - angles[i]));
  return sum;
}

// What passes through a gobo toward `local`, ahead of the light: bilinear.
vec3 goboTransmittance(const Texture& gobo, vec2 turn, vec3 local) {
  const vec2 size(float(gobo.width), float(gobo.height));
  const vec2 fromCenter = placeInGobo(turn, local);
  // Texels, from the center of the upper left one.
  const vec2 at = glm::clamp(0.5f * size + fromCenter - 0.5f, vec2(0), size - 1.0f);
  const uvec2 low(at);
  const uvec2 high = min(low + 1u, uvec2(gobo.width, gobo.height) - 1u);
  const vec2 fraction = at - vec2(low);
  const auto texel = [&](uint32_t x, uint32_t y) {
    return vec3(gobo.texels[std::size_t(y) * gobo.width + x]);
  };
  return mix(mix(texel(low.x, low.y), texel(high.x, low.y), fraction.x),
             mix(texel(low.x, high.y), texel(high.x, high.y), fraction.x), fraction.y);
}

}  // namespace

float profileFraction(const Profile& profile, vec3 local) {
  const ProfileView view{
      static_cast<uint>(profile.type), ivec2(profile.verticalAngles.size(), profile.horizontalAngles.size()),
      profile.verticalAngles.data(), profile.horizontalAngles.data(), profile.fractions.data()};
  return profileFraction(view, local);
}

ShapedLight shapedLight(const Scene& scene, const Light& light) {
  ShapedLight shaped;
  shaped.lamp = lampOf(light);
  if (light.type != LightType::spot) return shaped;
  shaped.frame = lightFrame(light.direction);
  if (light.profile != kNone) shaped.profile = &scene.profiles[light.profile];
  if (light.goboTexture != kNone) {
    shaped.gobo = &scene.textures[light.goboTexture];
    const float radius = 0.5f * float(std::min(shaped.gobo->width, shaped.gobo->height));
    const float rotation = glm::radians(light.goboRotation);
    shaped.goboTurn =
        radius / std::tan(glm::radians(light.outerAngle)) * vec2(std::cos(rotation), std::sin(rotation));
  }
  return shaped;
}

std::vector<ShapedLight> shapedLights(const Scene& scene) {
  std::vector<ShapedLight> lights;
  for (const Light& light : scene.lights) lights.push_back(shapedLight(scene, light));
  return lights;
}

vec3 lightIntensity(const ShapedLight& light, vec3 direction) {
  vec3 intensity = emitterPower(light.lamp, direction);
  if (!light.isShaped() || intensity == vec3(0)) return intensity;
  const vec3 local = alongFrame(light.frame, direction);
  if (light.profile) intensity *= profileFraction(*light.profile, local);
  if (light.gobo) intensity *= goboTransmittance(*light.gobo, light.goboTurn, local);
  return intensity;
}

vec3 illuminance(const ShapedLight& light, const Emitter& emitter, vec3 point) {
  if (!light.isShaped()) return emitterIlluminance(emitter, point);
  const vec3 offset = point - emitter.position;
  return lightIntensity(light, normalize(offset)) / dot(offset, offset);
}

double profileFlux(const Profile& profile) {
  const auto& verticals = profile.verticalAngles;
  const auto& horizontals = profile.horizontalAngles;
  const auto value = [&](std::size_t v, std::size_t h) -> double {
    return profile.fractions[h * verticals.size() + v];
  };
  double sum = 0, copies = 1;  // copies: by symmetry
  if (profile.type == PhotometryType::b) {
    sum = integral(verticals, [&](std::size_t v) {
      return integralOverSine(horizontals, -90, [&](std::size_t h) { return value(v, h); });
    });
  } else {
    const auto ofPlane = [&](std::size_t h) {
      return integralOverSine(verticals, profile.type == PhotometryType::c ? 0 : -90,
                              [&](std::size_t v) { return value(v, h); });
    };
    sum = horizontals.size() == 1 ? glm::radians(360.0) * ofPlane(0) : integral(horizontals, ofPlane);
  }
  if (profile.type != PhotometryType::c) {
    copies = (verticals.front() == 0 ? 2 : 1) * (horizontals.front() == 0 ? 2 : 1);
  } else if (horizontals.size() > 1) {
    copies = 360.0 / (horizontals.back() - horizontals.front());
  }
  return profile.peak * copies * sum;
}

}  // namespace nephroid
