#include "reference/sight.h"

#include <algorithm>

#include "trace/surface_color.h"

namespace nephroid {
namespace {

constexpr uint32_t kMostEncounters = 1024;
constexpr float kLeastThroughput = 1e-5f;

// Of a photon, as a line of sight in its own band finds it. Where both were dispersed, they have to have been
// so in the same band, which one in as many is.
vec3 fluxInBand(const StoredPhoton& photon, bool isSightDispersed, uint32_t band,
                const std::vector<Band>& bands) {
  if (photon.isDispersed && isSightDispersed)
    return photon.band == band ? photon.flux * bands[band].weight * float(bands.size()) : vec3(0);
  if (photon.isDispersed) return photon.flux * bands[photon.band].weight;
  return isSightDispersed ? photon.flux * bands[band].weight : photon.flux;
}

}  // namespace

Sight::Sight(const Scene& sceneToSee, const Boundaries& sceneBoundaries, const Lights& sceneLights)
    : scene_(sceneToSee), boundaries_(sceneBoundaries), lights_(sceneLights) {}

vec3 Sight::View::weight(const PassLight& light) const {
  return path.isDispersed ? path.throughput * light.bands[band].weight : path.throughput;
}

Seen Sight::look(const Ray& ray, const MediumStack& media, const PassLight& light, Random& random) const {
  View view;
  view.ray = ray;
  view.path.direction = ray.direction;
  view.path.media = media;
  if (light.bands.size() > 1) view.band = uint32_t(random.uniform() * float(light.bands.size()));
  Seen seen;
  Hit hit;
  for (uint32_t encounter = 0; encounter < kMostEncounters; ++encounter) {
    const bool isHit = boundaries_.rayScene().intersect(view.ray, hit);
    const float length = isHit ? hit.distance : std::numeric_limits<float>::infinity();
    if (boundaries_.isScattering(view.path.media.top()))
      seen.shafts += scattered(view, length, light, random);
    view.path.throughput *=
        boundaries_.transmittance(view.path.media.top(), view.ray.origin, view.ray.direction, length);
    if (!isHit) {
      seen.rest += view.weight(light) * scene_.environment.background;
      return seen;
    }
    view.traveled += length;
    if (!boundaries_.isCaster(hit)) {
      lookAtReceiver(view, hit, light, random, seen);
      return seen;
    }
    boundaries_.send(hit, light.bands[view.band], Carried::radiance, Choice::random, random, view.path);
    const vec3& left = view.path.throughput;
    if (std::max({left.x, left.y, left.z}) < kLeastThroughput) return seen;
    view.ray = boundaries_.rayScene().leavingTriangle(hit, view.path.direction);
  }
  return seen;
}

void Sight::lookAtReceiver(const View& view, const Hit& hit, const PassLight& light, Random& random,
                           Seen& seen) const {
  LitPoint point;
  point.position = hit.flatPosition;
  point.geometricNormal =
      dot(view.ray.direction, hit.geometricNormal) < 0 ? hit.geometricNormal : -hit.geometricNormal;
  point.normal = dot(hit.normal, point.geometricNormal) < 0 ? -hit.normal : hit.normal;
  point.medium = view.path.media.top();
  point.rounding = boundaries_.rayScene().rounding(hit.object);
  const vec3 weight = view.weight(light);
  const vec3 reflected = diffuseReflectance(scene_, hit) / kPi;  // 1/sr
  for (uint32_t source = 0; source < lights_.count(); ++source)
    seen.direct += weight * reflected * directIlluminance(boundaries_, lights_, source, point, random);
  if (view.path.metCaster || !light.isSplatted)
    seen.caustics += view.path.throughput * reflected * gather(view, hit, point.geometricNormal, light);
  seen.rest += weight * (reflected * scene_.environment.ambient + boundaries_.materialOf(hit).emission);
}

// lux, with the weight of bands, by the photons on a disk (Hachisuka et al. 2008; Epanechnikov's kernel).
vec3 Sight::gather(const View& view, const Hit& hit, vec3 normal, const PassLight& light) const {
  const float radius = std::min(light.surfaceRadius * view.traveled, light.largestRadius);
  vec3 sum(0);
  light.onSurfaces.around(hit.flatPosition, radius, [&](const StoredPhoton& photon, float squared) {
    if (photon.object != hit.object || dot(photon.direction, normal) < 0.3f) return;
    sum +=
        fluxInBand(photon, view.path.isDispersed, view.band, light.bands) * (1 - squared / (radius * radius));
  });
  return sum * (2 / (kPi * radius * radius));
}

// Light scattered once, in what the ray's next `length` (m) goes through.
vec3 Sight::scattered(const View& view, float length, const PassLight& light, Random& random) const {
  vec3 sum(0);
  for (uint32_t source = 0; source < lights_.count(); ++source)
    sum += view.weight(light) * scatteredFromLight(view, length, source, random);
  if (view.path.metCaster || !light.isSplatted)
    sum += view.path.throughput * scatteredFromCasters(view, length, light, random);
  return sum;
}

vec3 Sight::scatteredFromLight(const View& view, float length, uint32_t source, Random& random) const {
  const uint32_t medium = view.path.media.top();
  const float extinction = boundaries_.meanExtinction(medium);
  const float along = random.uniform();
  const float u = random.uniform();
  const bool isFromAfar = lights_.comesFromAfar(source);
  const DistanceSample sample = isFromAfar ? sampleExtinction(u, extinction, length)
                                           : sampleEquiangular(u, view.ray.origin, view.ray.direction, length,
                                                               lights_.position(source, along));
  const vec3 point = view.ray.origin + sample.distance * view.ray.direction;
  const Illumination illumination = lights_.illumination(source, point, along);
  if (illumination.illuminance == vec3(0) || !(sample.density > 0)) return vec3(0);
  if (!isLit(boundaries_.rayScene(), illumination, point, 0)) return vec3(0);
  vec3 left = boundaries_.transmittance(medium, view.ray.origin, view.ray.direction, sample.distance);
  if (!isFromAfar)
    left *= boundaries_.transmittance(medium, point, -illumination.direction, illumination.distance);
  return illumination.illuminance * left * boundaries_.scattering(medium, point) *
         (boundaries_.phase(medium, -dot(illumination.direction, view.ray.direction)) / sample.density);
}

// With the photons in balls around a few places of the ray. Each place is in its own part of the range that
// photons can be near.
vec3 Sight::scatteredFromCasters(const View& view, float length, const PassLight& light,
                                 Random& random) const {
  constexpr uint32_t kPlaces = 4;
  const uint32_t medium = view.path.media.top();
  const float extinction = boundaries_.meanExtinction(medium);
  const float largest = 3 * light.largestRadius;
  const vec2 part = light.inVolumes.reach(view.ray.origin, view.ray.direction, length, largest);
  vec3 sum(0);
  if (!(part.y > part.x)) return sum;
  for (uint32_t i = 0; i < kPlaces; ++i) {
    const DistanceSample sample =
        sampleExtinction((float(i) + random.uniform()) / float(kPlaces), extinction, part.y - part.x);
    const float distance = part.x + sample.distance;
    const float radius = std::min(light.volumeRadius * (view.traveled + distance), largest);
    const vec3 point = view.ray.origin + distance * view.ray.direction;
    vec3 near(0);
    light.inVolumes.around(point, radius, [&](const StoredPhoton& photon, float squared) {
      if (photon.object != medium) return;
      near += fluxInBand(photon, view.path.isDispersed, view.band, light.bands) *
              (boundaries_.phase(medium, -dot(photon.direction, view.ray.direction)) *
               (1 - squared / (radius * radius)));
    });
    const float kernel = 15 / (8 * kPi * radius * radius * radius);  // 1/m3
    const vec3 left = boundaries_.transmittance(medium, view.ray.origin, view.ray.direction, distance);
    sum += near * boundaries_.scattering(medium, point) * left * (kernel / (sample.density * float(kPlaces)));
  }
  return sum;
}

}  // namespace nephroid
