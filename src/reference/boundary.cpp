#include "reference/boundary.h"

#include <algorithm>
#include <cmath>

#include "optics/refraction.h"
#include "scene/air.h"

namespace nephroid {
namespace {

// The geometric normal on the side a path comes from, and the smooth one where it is on that side too.
struct Facing {
  vec3 geometric;
  vec3 smooth;
};

Facing facing(const Hit& hit, vec3 direction) {
  const vec3 geometric = dot(direction, hit.geometricNormal) < 0 ? hit.geometricNormal : -hit.geometricNormal;
  const vec3 smooth = dot(geometric, hit.normal) < 0 ? -hit.normal : hit.normal;
  return {geometric, dot(direction, smooth) < 0 ? smooth : geometric};
}

}  // namespace

Boundaries::Boundaries(const Scene& scene, const RayScene& rayScene)
    : rays_(rayScene), materials_(materialsOf(scene)), air_(scene.medium) {
  for (const Material* material : materials_) extinctions_.push_back(extinctionOf(*material));
  for (const Object& object : scene.objects) isCurved_.push_back(scene.meshOf(object).isCurved);
}

// A smooth normal may not send a path through the surface. Where it would, the triangle's own counts; but a
// photon on a mesh whose triangles are said to be flat is lost, as it is in other renderers. False: it is.
bool Boundaries::reflect(const Hit& hit, Carried carried, Path& path) const {
  const Facing normals = facing(hit, path.direction);
  const vec3 reflected = reflectDirection(path.direction, normals.smooth);
  const bool isSound = dot(reflected, normals.geometric) > 0;
  path.direction = isSound ? reflected : reflectDirection(path.direction, normals.geometric);
  return isSound || carried == Carried::radiance || isCurved_[hit.object];
}

bool Boundaries::send(const Hit& hit, const Band& band, Carried carried, Choice choice, Random& random,
                      Path& path) const {
  path.metCaster = true;
  const Material& material = *materials_[hit.object];
  if (material.type == MaterialType::mirror) {
    path.throughput *= material.color;
    return reflect(hit, carried, path);
  }
  if (material.isDispersive()) path.isDispersed = true;
  if (material.thinWalled) return crossThinWall(hit, band, carried, choice, random.uniform(), path);
  return crossDielectric(hit, band, carried, choice, random.uniform(), path);
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
  const Facing normals = facing(hit, path.direction);
  vec3 normal = normals.smooth;
  vec3 transmitted;
  bool canTransmit = refractDirection(path.direction, normal, eta, transmitted);
  if (canTransmit && dot(transmitted, normals.geometric) >= 0) {
    normal = normals.geometric;
    canTransmit = refractDirection(path.direction, normal, eta, transmitted);
  }
  const float reflectance =
      canTransmit ? fresnelReflectance(std::min(1.0f, -dot(path.direction, normal)), eta) : 1.0f;
  if (choice == Choice::transmitted && !canTransmit) return false;
  if (choice != Choice::random)
    path.throughput *= choice == Choice::reflected ? reflectance : 1 - reflectance;
  if (choice == Choice::reflected || (choice == Choice::random && u < reflectance))
    return reflect(hit, carried, path);
  path.direction = transmitted;
  path.media = beyond;
  if (carried == Carried::radiance) path.throughput *= eta * eta;
  return true;
}

// A sheet too thin to bend light: what both its faces let through, reflections between them included.
bool Boundaries::crossThinWall(const Hit& hit, const Band& band, Carried carried, Choice choice, float u,
                               Path& path) const {
  const Material& material = *materials_[hit.object];
  const Facing normals = facing(hit, path.direction);
  const float face = fresnelReflectance(std::min(1.0f, -dot(path.direction, normals.smooth)),
                                        1 / indexOfRefraction(material, band));
  const float transmitted = (1 - face) / (1 + face);
  if (choice != Choice::random)
    path.throughput *= choice == Choice::reflected ? 1 - transmitted : transmitted;
  if (choice == Choice::reflected || (choice == Choice::random && u >= transmitted))
    return reflect(hit, carried, path);
  path.throughput *= material.color;
  return true;
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
