#include "scene/light_intensity.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "scene/mesh_file.h"

namespace nephroid {
namespace {

constexpr float kNearlyVertical = 1e-4f;  // sine of the angle from the vertical

// Where an angle lies between two neighbours.
struct Bracket {
  std::size_t low = 0;
  float fraction = 0;  // of the way to the next
};

// `angle` within the angles, of which there are two or more. Mostly they are evenly spaced.
Bracket bracketOf(const std::vector<float>& angles, float angle) {
  const std::size_t last = angles.size() - 2;
  const float even = (angle - angles.front()) / (angles.back() - angles.front()) * float(angles.size() - 1);
  std::size_t low = std::min(static_cast<std::size_t>(std::max(even, 0.0f)), last);
  if (!(angles[low] <= angle && angle <= angles[low + 1])) {
    const auto above = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
    low = static_cast<std::size_t>(above - angles.begin()) - 1;
  }
  const float fraction = (angle - angles[low]) / (angles[low + 1] - angles[low]);
  return {low, glm::clamp(fraction, 0.0f, 1.0f)};
}

// The horizontal angle, 0 to 360, as the file has it by symmetry.
float foldedTypeC(const std::vector<float>& angles, float horizontal) {
  const float first = angles.front(), last = angles.back();
  if (first == 90 && last == 270) {
    if (horizontal < 90) return 180 - horizontal;
    return horizontal > 270 ? 540 - horizontal : horizontal;
  }
  if (last <= 180 && horizontal > 180) horizontal = 360 - horizontal;
  if (last <= 90 && horizontal > 90) horizontal = 180 - horizontal;
  return horizontal;
}

float degreesOf(float y, float x) {
  return glm::degrees(std::atan2(y, x));
}

// An angle of type A or B as the file has it by symmetry.
float foldedTypeAOrB(const std::vector<float>& angles, float angle) {
  return angles.front() == 0 ? std::abs(angle) : angle;
}

float fractionAt(const Profile& profile, float vertical, float horizontal) {
  if (vertical < profile.verticalAngles.front() || vertical > profile.verticalAngles.back()) return 0;
  const Bracket v = bracketOf(profile.verticalAngles, vertical);
  const std::size_t stride = profile.verticalAngles.size();
  const float* values = profile.fractions.data() + v.low;
  if (profile.horizontalAngles.size() == 1) return glm::mix(values[0], values[1], v.fraction);
  const Bracket h = bracketOf(profile.horizontalAngles, horizontal);
  values += h.low * stride;
  return glm::mix(glm::mix(values[0], values[1], v.fraction),
                  glm::mix(values[stride], values[stride + 1], v.fraction), h.fraction);
}

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
vec3 goboTransmittance(const Texture& gobo, float scale, vec3 local) {
  const vec2 size(float(gobo.width), float(gobo.height));
  const vec2 fromCentre = vec2(local.x, -local.y) * (scale / local.z);
  // Texels, from the centre of the upper left one.
  const vec2 at = glm::clamp(0.5f * size + fromCentre - 0.5f, vec2(0), size - 1.0f);
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

LightFrame lightFrame(vec3 direction) {
  LightFrame frame;
  frame.forward = direction;
  const vec2 level(direction.x, direction.z);
  const float sine = length(level);
  // Near the vertical, as of a light that faces -Z and is tilted there.
  const vec2 ahead = sine > kNearlyVertical ? level / sine : vec2(0, -1);
  frame.right = vec3(-ahead.y, 0, ahead.x);
  frame.up = glm::normalize(cross(frame.right, direction));
  frame.right = cross(direction, frame.up);
  return frame;
}

float profileFraction(const Profile& profile, vec3 local) {
  const auto& verticals = profile.verticalAngles;
  const auto& horizontals = profile.horizontalAngles;
  if (profile.type == PhotometryType::c) {
    const float vertical = degreesOf(length(vec2(local)), local.z);
    if (horizontals.size() == 1) return fractionAt(profile, vertical, 0);
    const float horizontal = degreesOf(-local.x, local.y);
    return fractionAt(profile, vertical,
                      foldedTypeC(horizontals, horizontal < 0 ? horizontal + 360 : horizontal));
  }
  const bool isTypeA = profile.type == PhotometryType::a;
  const float latitude = glm::degrees(std::asin(glm::clamp(isTypeA ? local.y : local.x, -1.0f, 1.0f)));
  const float longitude = degreesOf(isTypeA ? local.x : local.y, local.z);
  const float vertical = foldedTypeAOrB(verticals, isTypeA ? latitude : longitude);
  const float horizontal = foldedTypeAOrB(horizontals, isTypeA ? longitude : latitude);
  if (horizontal < horizontals.front() || horizontal > horizontals.back()) return 0;
  return fractionAt(profile, vertical, horizontal);
}

ShapedLight shapedLight(const Scene& scene, const Light& light) {
  ShapedLight shaped;
  shaped.intensity = light.intensity;
  if (light.type != LightType::spot) return shaped;
  shaped.cone = coneOf(light);
  shaped.frame = lightFrame(light.direction);
  if (light.profile != kNone) shaped.profile = &scene.profiles[light.profile];
  if (light.goboTexture != kNone) {
    shaped.gobo = &scene.textures[light.goboTexture];
    const float radius = 0.5f * float(std::min(shaped.gobo->width, shaped.gobo->height));
    shaped.goboScale = radius / std::tan(glm::radians(light.outerAngle));
  }
  return shaped;
}

vec3 lightIntensity(const ShapedLight& light, vec3 direction) {
  const LightFrame& frame = light.frame;
  const vec3 local(dot(direction, frame.right), dot(direction, frame.up), dot(direction, frame.forward));
  const float falloff = coneFalloff(local.z, light.cone.scale, light.cone.offset);
  if (!(falloff > 0)) return vec3(0);
  vec3 intensity = light.intensity * falloff;
  if (light.profile) intensity *= profileFraction(*light.profile, local);
  if (light.gobo) intensity *= goboTransmittance(*light.gobo, light.goboScale, local);
  return intensity;
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

std::string whyNotDrawable(const Light& light) {
  if (light.goboTexture == kNone && light.profile == kNone) return "";
  return "the light \"" + light.name + "\" has " +
         (light.goboTexture != kNone ? "a gobo" : "an IES profile") +
         ", which only --technique reference draws";
}

void requireDrawableLights(const Scene& scene) {
  for (const Light& light : scene.lights)
    if (const std::string why = whyNotDrawable(light); !why.empty())
      throw InputError(oneLine(scene.file.string() + ": " + why));
}

}  // namespace nephroid
