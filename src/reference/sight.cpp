#include "reference/sight.h"

#include <algorithm>

#include "core/color.h"
#include "trace/surface_color.h"

namespace nephroid {
namespace {

constexpr uint32_t kMostEncounters = 1024;
constexpr float kLeastThroughput = 1e-5f;
constexpr uint32_t kMostSplits = 3;
constexpr float kLeastSplit = 0.02f;  // of the throughput
constexpr float kLeastPart = 0.005f;  // of the light, that is worth a way of its own

float largest(vec3 v) {
  return std::max({v.x, v.y, v.z});
}

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
    : scene_(sceneToSee), boundaries_(sceneBoundaries), lights_(sceneLights), skies_(sceneToSee) {
  skies_.place(sceneToSee);
}

vec3 Sight::View::weight(const PassLight& light) const {
  return path.isDispersed ? path.throughput * light.bands[band].weight : path.throughput;
}

Seen Sight::look(const Ray& ray, const MediumStack& media, const PassLight& light, Draws& draws) const {
  View view;
  view.ray = ray;
  view.path.direction = ray.direction;
  view.path.media = media;
  if (light.bands.size() > 1) view.band = uint32_t(draws.uniform() * float(light.bands.size()));
  Seen seen;
  follow(view, light, draws, seen);
  return seen;
}

void Sight::follow(View view, const PassLight& light, Draws& draws, Seen& seen) const {
  Hit hit;
  while (view.encounters < kMostEncounters) {
    const bool isHit = boundaries_.rayScene().intersect(view.ray, hit);
    const float length = isHit ? hit.distance : std::numeric_limits<float>::infinity();
    if (boundaries_.isScattering(view.path.media.top())) seen.shafts += scattered(view, length, light, draws);
    view.path.throughput *=
        boundaries_.transmittance(view.path.media.top(), view.ray.origin, view.ray.direction, length);
    if (!isHit) {
      const vec3 sky = skies_.luminance(view.ray.direction, 0);
      seen.rest += view.weight(light) * (scene_.environment.background + sky);
      return;
    }
    view.traveled += length;
    if (!boundaries_.isCaster(hit)) return lookAtReceiver(view, hit, light, draws, seen);
    View reflected = view;
    const bool isSplit = splits(hit, light, view, reflected);
    if (isSplit) {
      Draws others = draws.branch();
      follow(reflected, light, others, seen);
    }
    if (!goOn(hit, light, isSplit ? Choice::transmitted : Choice::random, draws.uniform(), view)) return;
  }
}

// Whether the view goes on by both ways; `reflected` is then one of them, and `view` has to take the other.
bool Sight::splits(const Hit& hit, const PassLight& light, View& view, View& reflected) const {
  const float before = largest(view.path.throughput);
  if (view.splits == kMostSplits || before < kLeastSplit ||
      boundaries_.materialOf(hit).type != MaterialType::dielectric ||
      !goOn(hit, light, Choice::reflected, 0, reflected))
    return false;
  const float part = largest(reflected.path.throughput) / before;
  if (part < kLeastPart || part > 1 - kLeastPart) return false;
  reflected.splits = ++view.splits;
  return true;
}

// From a caster. False: there is nothing more to see this way.
bool Sight::goOn(const Hit& hit, const PassLight& light, Choice choice, float u, View& view) const {
  if (!boundaries_.send(hit, light.bands[view.band], Carried::radiance, choice, u, view.path)) return false;
  if (largest(view.path.throughput) < kLeastThroughput) return false;
  ++view.encounters;
  view.ray = boundaries_.rayScene().leavingTriangle(hit, view.path.direction);
  return true;
}

void Sight::lookAtReceiver(const View& view, const Hit& hit, const PassLight& light, Draws& draws,
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
    seen.direct +=
        weight * reflected * directIlluminance(boundaries_, lights_, source, point, draws.uniform());
  if (view.path.metCaster || !light.isSplatted)
    seen.caustics += gather(view, hit, point, view.path.throughput * reflected, light);
  seen.rest += weight * (reflected * scene_.environment.ambient + boundaries_.materialOf(hit).emission);
}

// nit, by the photons on a disk (Hachisuka et al. 2008; Epanechnikov's kernel). `reflected`: 1/sr, with what
// is left on the way to the camera.
vec3 Sight::gather(const View& view, const Hit& hit, const LitPoint& point, vec3 reflected,
                   const PassLight& light) const {
  const float radius = std::min(light.surfaceRadius * view.traveled, light.largestRadius);
  const vec3 highest = reflected * (2 / (kPi * radius * radius));
  vec3 sum(0);
  light.onSurfaces.around(hit.flatPosition, radius, [&](const StoredPhoton& photon, float squared) {
    if (photon.object != hit.object || dot(photon.direction, point.geometricNormal) < 0.3f) return;
    const vec3 luminance = fluxInBand(photon, view.path.isDispersed, view.band, light.bands) * highest *
                           (1 - squared / (radius * radius));
    sum += luminance;
    if (light.worths) light.worths->add(photon.index, luminanceOf(luminance));
  });
  return sum;
}

// Light scattered once, in what the ray's next `length` (m) goes through.
vec3 Sight::scattered(const View& view, float length, const PassLight& light, Draws& draws) const {
  vec3 sum(0);
  for (uint32_t source = 0; source < lights_.count(); ++source)
    sum += view.weight(light) * scatteredFromLight(view, length, source, draws);
  if (view.path.metCaster || !light.isSplatted)
    sum += view.path.throughput * scatteredFromCasters(view, length, light, draws);
  return sum;
}

vec3 Sight::scatteredFromLight(const View& view, float length, uint32_t source, Draws& draws) const {
  const uint32_t medium = view.path.media.top();
  const float extinction = boundaries_.meanExtinction(medium);
  const float along = draws.uniform();
  const float u = draws.uniform();
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
vec3 Sight::scatteredFromCasters(const View& view, float length, const PassLight& light, Draws& draws) const {
  constexpr uint32_t kPlaces = 4;
  const uint32_t medium = view.path.media.top();
  const float extinction = boundaries_.meanExtinction(medium);
  const float largest = 3 * light.largestRadius;
  const vec2 part = light.inVolumes.reach(view.ray.origin, view.ray.direction, length, largest);
  vec3 sum(0);
  if (!(part.y > part.x)) return sum;
  for (uint32_t i = 0; i < kPlaces; ++i) {
    const DistanceSample sample =
        sampleExtinction((float(i) + draws.uniform()) / float(kPlaces), extinction, part.y - part.x);
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
