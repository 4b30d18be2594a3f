#include "render/lamp_exposure.h"

#include <algorithm>
#include <cmath>

#include "core/color.h"
#include "core/random.h"
#include "scene/air.h"

namespace nephroid {
namespace {

constexpr uint32_t kInRound = 64, kMostRounds = 16;
constexpr float kRounding = 1e-5f;  // of a sum of many numbers

// Point `i` of a sequence whose beginnings are spread evenly over the unit cube of four dimensions (Roberts
// 2018), moved by `start`.
vec4 spreadPoint(vec4 start, uint32_t i) {
  const glm::dvec4 at =
      glm::dvec4(start) + double(i) * glm::dvec4(0.85667488, 0.73389185, 0.62870672, 0.53859725);
  return vec4(at - floor(at));
}

}  // namespace

LampExposure::LampExposure(const Scene& scene, const RayScene& rays, const Sensor& sensor, float error)
    : scene_(scene), rays_(rays), sensor_(sensor), error_(error) {
  for (const Light& light : scene.lights)
    if (hasSize(light)) lamps_.push_back({&light, shapedLight(scene, light)});
}

vec3 LampExposure::onTexel(uvec2 texel) const {
  vec3 sum(0);
  for (uint32_t i = 0; i < lamps_.size(); ++i) sum += ofLamp(lamps_[i], texel, i);
  return sum;
}

// Points of the texel, each with a place of the lamp: more where some are in shadow and some are not.
vec3 LampExposure::ofLamp(const Lamp& lamp, uvec2 texel, uint32_t seed) const {
  Random random(uint64_t(texel.y) << 32 | texel.x, seed);
  vec4 start;
  for (int i = 0; i < 4; ++i) start[i] = random.uniform();
  const vec3 normal = sensor_.normal();
  vec3 lit(0);
  float whole = 0, squares = 0, kept = 0;
  for (uint32_t round = 1;; ++round) {
    vec3 ofRound(0);
    for (uint32_t i = 0; i < kInRound; ++i) {
      const vec4 at = spreadPoint(start, (round - 1) * kInRound + i);
      const vec2 place = (vec2(texel) + vec2(at)) / vec2(sensor_.resolution);
      const vec3 point = sensor_.corner + sensor_.u * place.x + sensor_.v * place.y;
      const Illumination from = lampLight(*lamp.light, lamp.shaped, point, vec2(at.z, at.w));
      const float cosine = -dot(from.direction, normal);
      if (cosine <= 0 || from.illuminance == vec3(0)) continue;
      vec3 lux = cosine * from.illuminance;
      if (scene_.medium && std::isfinite(from.distance))
        lux *= std::exp(-opticalDepth(*scene_.medium, point, -from.direction, from.distance));
      whole += luminanceOf(lux);
      if (!rays_.occluded(rays_.fromMeter(point, -from.direction, cosine, from.distance))) ofRound += lux;
    }
    lit += ofRound;
    const float luminance = luminanceOf(ofRound), rounds = float(round);
    kept += luminance;
    squares += luminance * luminance;
    const bool isMixed = kept > 0 && kept < (1 - kRounding) * whole;
    // Of the mean of the rounds, squared.
    const float variance = (squares / rounds - kept * kept / (rounds * rounds)) / std::max(rounds - 1, 1.0f);
    const float allowed = error_ * whole / rounds;
    if (!isMixed || round == kMostRounds || (round > 1 && variance <= allowed * allowed))
      return lit / (rounds * float(kInRound));
  }
}

}  // namespace nephroid
