#include "reference/boundary.h"

#include <algorithm>
#include <cmath>

#include "scene/air.h"
#include "trace/crossing.h"

namespace nephroid {

Boundaries::Boundaries(const Scene& scene, const RayScene& rayScene)
    : rays_(rayScene), materials_(materialsOf(scene)), air_(scene.medium) {
  for (const Material* material : materials_) extinctions_.push_back(extinctionOf(*material));
}

bool Boundaries::send(const Hit& hit, const Band& band, Carried carried, Choice choice, float u,
                      Path& path) const {
  path.metCaster = true;
  const Material& material = *materials_[hit.object];
  if (material.type == MaterialType::mirror) {
    path.throughput *= material.color;
    reflect(hit, path);
    return true;
  }
  if (material.isDispersive()) path.isDispersed = true;
  if (material.thinWalled) {
    crossThinWall(hit, band, choice, u, path);
    return true;
  }
  return crossDielectric(hit, band, carried, choice, u, path);
}

bool Boundaries::crossDielectric(const Hit& hit, const Band& band, Carried carried, Choice choice, float u,
                                 Path& path) const {
  const MediaSides sides = sidesOf(rays_, path.media, hit, path.direction);
  path.media = sides.before;
  const MediumStack& beyond = sides.beyond;
  const uint32_t here = path.media.top();
  const uint32_t there = beyond.top();
  if (here == there) {  // inside another object, which fills this place: nothing is reflected
    path.media = beyond;
    if (choice == Choice::reflected) path.throughput = vec3(0);
    return choice != Choice::reflected;
  }

  const float eta = indexIn(here, band) / indexIn(there, band);
  const Bend bend = bendAt(path.direction, hit.normal, hit.geometricNormal, eta);
  if (choice == Choice::transmitted && bend.reflectance >= 1) return false;
  if (choice != Choice::random)
    path.throughput *= choice == Choice::reflected ? bend.reflectance : 1 - bend.reflectance;
  if (choice == Choice::reflected || (choice == Choice::random && u < bend.reflectance)) {
    path.direction = bend.reflected;
    return true;
  }
  path.direction = bend.transmitted;
  path.media = beyond;
  if (carried == Carried::radiance) path.throughput *= eta * eta;
  return true;
}

// A sheet too thin to bend light: what both its faces let through, reflections between them included.
void Boundaries::crossThinWall(const Hit& hit, const Band& band, Choice choice, float u, Path& path) const {
  const Material& material = *materials_[hit.object];
  const vec3 normal = facingNormal(path.direction, hit.normal, hit.geometricNormal);
  const float face =
      fresnelReflectance(std::min(1.0f, -dot(path.direction, normal)), 1 / indexOfRefraction(material, band));
  const float transmitted = (1 - face) / (1 + face);
  if (choice != Choice::random)
    path.throughput *= choice == Choice::reflected ? 1 - transmitted : transmitted;
  if (choice == Choice::reflected || (choice == Choice::random && u >= transmitted)) {
    reflect(hit, path);
  } else {
    path.throughput *= material.color;
  }
}

void Boundaries::reflect(const Hit& hit, Path& path) const {
  path.direction = reflectedBy(path.direction, hit.normal, hit.geometricNormal).direction;
}

vec3 Boundaries::transmittance(uint32_t object, vec3 from, vec3 direction, float length) const {
  if (object == kNone) return vec3(air_ ? std::exp(-opticalDepth(*air_, from, direction, length)) : 1.0f);
  const vec3 extinction = extinctions_[object];
  if (extinction == vec3(0)) return vec3(1);
  return glm::exp(-extinction * length);
}

bool Boundaries::isScattering(uint32_t object) const {
  return object == kNone ? air_ && scatters(*air_) : scatters(*materials_[object]);
}

vec3 Boundaries::scattering(uint32_t object, vec3 point) const {
  return object == kNone ? vec3(scatteringAt(*air_, point)) : materials_[object]->scattering;
}

float Boundaries::phase(uint32_t object, float cosine) const {
  if (object == kNone) return phaseOf(*air_, cosine);
  return phaseFunction(phaseCode(materials_[object]->phase), materials_[object]->g, cosine);
}

float Boundaries::meanExtinction(uint32_t object) const {
  if (object == kNone) return air_ ? air_->extinction : 0;
  const vec3& extinction = extinctions_[object];
  return (extinction.x + extinction.y + extinction.z) / 3;
}

MediumStack Boundaries::mediaAround(vec3 point) const {
  return nephroid::mediaAround(rays_, materials_, point);
}

float Boundaries::indexIn(uint32_t object, const Band& band) const {
  return object == kNone ? 1.0f : indexOfRefraction(*materials_[object], band);
}

}  // namespace nephroid
