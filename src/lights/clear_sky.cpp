#include "lights/clear_sky.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/color.h"
#include "core/colorimetry.h"
#include "core/directions.h"
#include "lights/sky.h"

namespace nephroid {
namespace {

constexpr uvec2 kMapSize{512, 256};  // of an even height: the horizon lies between two rows
constexpr float kNitInKilo = 1000;

// The five parameters of Perez's distribution.
using Perez = std::array<float, 5>;

float distribution(const Perez& p, float cosZenith, float angle) {
  const float cosine = std::cos(angle);
  return (1 + p[0] * std::exp(p[1] / std::max(cosZenith, 1e-4f))) *
         (1 + p[2] * std::exp(p[3] * angle) + p[4] * cosine * cosine);
}

// Of luminance and of the chromaticities x and y (section A.2).
struct Distributions {
  Perez luminance, x, y;
  explicit Distributions(float t)
      : luminance{0.1787f * t - 1.4630f, -0.3554f * t + 0.4275f, -0.0227f * t + 5.3251f,
                  0.1206f * t - 2.5771f, -0.0670f * t + 0.3703f},
        x{-0.0193f * t - 0.2592f, -0.0665f * t + 0.0008f, -0.0004f * t + 0.2125f, -0.0641f * t - 0.8989f,
          -0.0033f * t + 0.0452f},
        y{-0.0167f * t - 0.2608f, -0.0950f * t + 0.0092f, -0.0079f * t + 0.2102f, -0.0441f * t - 1.6537f,
          -0.0109f * t + 0.0529f} {}
};

float cubic(vec4 coefficients, float x) {
  return dot(coefficients, vec4(x * x * x, x * x, x, 1));
}

// Luminance (nit) and chromaticity of the zenith (section A.2).
vec3 zenith(float t, float sunZenith) {
  const float chi = (4.0f / 9 - t / 120) * (kPi - 2 * sunZenith);
  const float luminance =
      kNitInKilo * std::max((4.0453f * t - 4.9710f) * std::tan(chi) - 0.2155f * t + 2.4192f, 0.0f);
  const vec3 powers(t * t, t, 1);
  const float x = dot(powers, vec3(cubic({0.00166f, -0.00375f, 0.00209f, 0}, sunZenith),
                                   cubic({-0.02903f, 0.06377f, -0.03202f, 0.00394f}, sunZenith),
                                   cubic({0.11693f, -0.21196f, 0.06052f, 0.25886f}, sunZenith)));
  const float y = dot(powers, vec3(cubic({0.00275f, -0.00610f, 0.00317f, 0}, sunZenith),
                                   cubic({-0.04214f, 0.08970f, -0.04153f, 0.00516f}, sunZenith),
                                   cubic({0.15346f, -0.26756f, 0.06670f, 0.26688f}, sunZenith)));
  return {luminance, x, y};
}

// The same for many directions.
class Model {
 public:
  explicit Model(const ClearSky& clear) : distributions_(clear.turbidity), sun_(towardSun(clear)) {
    const float sunZenith = glm::radians(90 - clear.elevation);
    zenith_ = zenith(clear.turbidity, sunZenith);
    atZenith_ = distributionsAt(1, sunZenith);
  }

  vec3 luminance(vec3 toward) const {
    const float angle = std::acos(std::clamp(dot(toward, sun_), -1.0f, 1.0f));
    const vec3 color = zenith_ * distributionsAt(toward.y, angle) / atZenith_;
    const float x = color.y, y = color.z;
    return glm::max(rec709FromXyz(color.x * vec3(x / y, 1, (1 - x - y) / y)), vec3(0));
  }

 private:
  vec3 distributionsAt(float cosZenith, float angle) const {
    return {distribution(distributions_.luminance, cosZenith, angle),
            distribution(distributions_.x, cosZenith, angle),
            distribution(distributions_.y, cosZenith, angle)};
  }

  Distributions distributions_;
  vec3 sun_;
  vec3 zenith_{0}, atZenith_{1};
};

// Table 2: from 380 to 750 nm in steps of 10.
constexpr float kFirstWavelength = 380, kWavelengthStep = 10;
constexpr std::size_t kWavelengths = 38;
// Radiance of the sun outside of the air, W / (m2 sr nm).
constexpr std::array<float, kWavelengths> kSunRadiance{
    16559,    16233.7f, 21127.5f, 25888.2f, 25829.1f, 24232.3f, 26760.5f, 29658.3f, 30545.4f, 30057.5f,
    30663.7f, 28830.4f, 28712.1f, 27825,    27100.6f, 27233.6f, 26361.3f, 25503.8f, 25060.2f, 25311.6f,
    25355.9f, 25134.2f, 24631.5f, 24173.2f, 23685.3f, 23212.1f, 22827.7f, 22339.8f, 21970.2f, 21526.7f,
    21097.9f, 20728.3f, 20240.4f, 19870.8f, 19427.2f, 19072.4f, 18628.9f, 18259.2f};
// Absorption of ozone, 1/cm.
constexpr std::array<float, kWavelengths> kOzone{
    0,      0,      0,      0,      0,      0,      0,      0.003f, 0.006f, 0.009f, 0.014f, 0.021f, 0.03f,
    0.04f,  0.048f, 0.063f, 0.075f, 0.085f, 0.103f, 0.12f,  0.12f,  0.115f, 0.125f, 0.12f,  0.105f, 0.09f,
    0.079f, 0.067f, 0.057f, 0.048f, 0.036f, 0.028f, 0.023f, 0.018f, 0.014f, 0.011f, 0.01f,  0.009f};
// Absorption of water vapor, 1/cm, of the last wavelengths; before it is 0. Mixed gases absorb at no
// wavelength of the table.
constexpr std::array<float, 7> kWaterVapor{0.016f, 0.024f, 0.0125f, 1, 0.87f, 0.061f, 0.001f};
constexpr float kOzoneDepth = 0.35f, kVaporDepth = 2;  // cm
constexpr float kSunSolidAngle = 6.7443e-5f;           // sr, as the paper has it

// The part of sunlight that the air leaves (section A.1). `mass`: of the air, that at the zenith being 1.
float transmittance(std::size_t i, float mass, float turbidity) {
  const float micrometers = (kFirstWavelength + kWavelengthStep * float(i)) / 1000;
  const float aerosol = 0.04608f * turbidity - 0.04586f;
  const float depth = 0.008735f * std::pow(micrometers, -4.08f) + aerosol * std::pow(micrometers, -1.3f) +
                      kOzone[i] * kOzoneDepth;
  const std::size_t before = kWavelengths - kWaterVapor.size();
  const float vapor = i < before ? 0 : kWaterVapor[i - before] * kVaporDepth * mass;
  return std::exp(-depth * mass - 0.2385f * vapor / std::pow(1 + 20.07f * vapor, 0.45f));
}

}  // namespace

vec3 towardSun(const ClearSky& clear) {
  const float azimuth = glm::radians(clear.azimuth), elevation = glm::radians(clear.elevation);
  return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
          -std::cos(azimuth) * std::cos(elevation)};
}

vec3 clearSkyLuminance(const ClearSky& clear, vec3 toward) {
  return Model(clear).luminance(toward);
}

vec3 sunIlluminance(const ClearSky& clear) {
  const float zenithAngle = 90 - clear.elevation;  // degrees
  const float mass =
      1 / (std::cos(glm::radians(zenithAngle)) + 0.15f * std::pow(93.885f - zenithAngle, -1.253f));
  vec3 xyz(0);
  for (std::size_t i = 0; i < kWavelengths; ++i)
    xyz += kSunRadiance[i] * transmittance(i, mass, clear.turbidity) *
           colorMatching(kFirstWavelength + kWavelengthStep * float(i));
  return glm::max(rec709FromXyz(xyz * (kMostLumensPerWatt * kSunSolidAngle * kWavelengthStep)), vec3(0));
}

SkyMap clearSkyMap(const ClearSky& clear) {
  const Model model(clear);
  SkyMap map{{}, kMapSize, {}};
  const uint32_t horizon = map.size.y / 2;
  map.luminance.reserve(std::size_t{map.size.x} * map.size.y);
  vec3 onGround = sunIlluminance(clear) * towardSun(clear).y;  // lux
  for (uint32_t y = 0; y < horizon; ++y)
    for (uint32_t x = 0; x < map.size.x; ++x) {
      const vec3 toward = towardSky((vec2(x, y) + 0.5f) / vec2(map.size));
      map.luminance.push_back(model.luminance(toward));
      onGround += map.luminance.back() * (skyCellAngle(map, y) * toward.y);
    }
  map.luminance.resize(std::size_t{map.size.x} * map.size.y, clear.ground * onGround / kPi);
  return map;
}

Light makeClearSky(const ClearSky& clear, Scene& scene, Light& sky) {
  std::string name = "clear sky";
  for (const float value :
       {clear.azimuth, clear.elevation, clear.turbidity, clear.ground.x, clear.ground.y, clear.ground.z})
    name += " " + std::to_string(value);
  const auto there = std::ranges::find(scene.skies, name, &SkyMap::name);
  sky.skyMap = static_cast<uint32_t>(there - scene.skies.begin());
  if (there == scene.skies.end()) {
    scene.skies.push_back(clearSkyMap(clear));
    scene.skies.back().name = name;
  }
  sky.type = LightType::sky;
  sky.sky = skyParts(scene.skies[sky.skyMap], sky.samples);
  Light sun;
  sun.name = sky.name + " sun";
  sun.type = LightType::directional;
  sun.direction = skyTurned(sky.skyRotation) * -towardSun(clear);
  sun.angle = kSunAngle;
  sun.illuminance = sky.intensity * sunIlluminance(clear);
  return sun;
}

Light sunWithSky(const Light& sunBefore, const Light& skyBefore, const Light& sky) {
  Light sun = sunBefore;
  for (int c = 0; c < 3; ++c)
    if (skyBefore.intensity[c] > 0) sun.illuminance[c] *= sky.intensity[c] / skyBefore.intensity[c];
  sun.direction = normalize(skyTurned(sky.skyRotation - skyBefore.skyRotation) * sun.direction);
  return sun;
}

}  // namespace nephroid
