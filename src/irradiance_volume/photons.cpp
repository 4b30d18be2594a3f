#include "irradiance_volume/photons.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "irradiance_volume/light_samples.h"
#include "optics/refraction.h"
#include "transport/queries.h"

namespace nephroid {
namespace {

constexpr uint32_t kPhotonsPerBlock = 1024;
constexpr float kLeastShare = 1e-4f;  // of a photon's flux that is still worth a path

// Evenly over the unit disk: the plastic number's sequence (Roberts 2018) on a square that is mapped to it
// concentrically (Shirley and Chiu 1997).
vec2 onDisc(uint32_t index) {
  const double plastic = 1.32471795724474602596;
  const double u = 0.5 + double(index + 1) / plastic;
  const double v = 0.5 + double(index + 1) / (plastic * plastic);
  const vec2 square(float(2 * (u - std::floor(u)) - 1), float(2 * (v - std::floor(v)) - 1));
  if (square == vec2(0)) return vec2(0);
  const bool isWide = std::abs(square.x) > std::abs(square.y);
  const float radius = isWide ? square.x : square.y;
  const float angle =
      0.25f * std::numbers::pi_v<float> * (isWide ? square.y / square.x : 2 - square.x / square.y);
  return radius * vec2(std::cos(angle), std::sin(angle));
}

// Distance from `origin`, inside, to where a line leaves the sphere of `radius` about the center; 0 from
// outside it.
float lengthInside(vec3 origin, vec3 direction, float radius) {
  const float along = dot(origin, direction);
  const float inside = radius * radius - dot(origin, origin);
  return inside > 0 ? -along + std::sqrt(along * along + inside) : 0.0f;
}

vec3 facing(vec3 direction, const Hit& hit) {
  const vec3 normal =
      dot(direction, hit.normal) * dot(direction, hit.geometricNormal) > 0 ? hit.normal : hit.geometricNormal;
  return dot(direction, normal) < 0 ? normal : -normal;
}

// What `find` adds for each of the photons, in their order.
template <class Item, class Find>
std::vector<Item> inBlocks(uint32_t photons, const Find& find) {
  const uint32_t blocks = (photons + kPhotonsPerBlock - 1) / kPhotonsPerBlock;
  std::vector<std::vector<Item>> ofBlock(blocks);
  oneapi::tbb::parallel_for(uint32_t{0}, blocks, [&](uint32_t block) {
    const uint32_t end = std::min(photons, (block + 1) * kPhotonsPerBlock);
    for (uint32_t i = block * kPhotonsPerBlock; i < end; ++i) find(i, ofBlock[block]);
  });
  std::vector<Item> all;
  for (const std::vector<Item>& part : ofBlock) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

CasterTracer::CasterTracer(const Mesh& mesh, const Material& material, Paths paths)
    : material_(material),
      paths_(paths),
      rays_(mesh),
      follower_(rays_, {&material_}),
      sphere_(boundingSphere(mesh)),
      symmetry_(findSymmetry(rays_, sphere_)) {}

// A mirror's light crosses the air between its bounces too.
void CasterTracer::reflect(Hit hit, vec3 direction, vec3 flux, std::vector<PhotonPath>& paths) const {
  for (uint32_t bounce = 0; bounce < kMaximumCrossings; ++bounce) {
    direction = reflectDirection(direction, facing(direction, hit));
    flux *= material_.color;
    const Ray next = rays_.leaving(hit, direction);
    PhotonPath path{hit.position, direction, flux, std::numeric_limits<float>::infinity()};
    const bool goesOn = rays_.intersect(next, hit);
    if (goesOn) path.length = length(hit.position - path.origin);
    paths.push_back(path);
    if (!goesOn) return;
  }
}

void CasterTracer::follow(const Hit& first, vec3 direction, vec3 flux, std::vector<PhotonPath>& paths) const {
  if (material_.type == MaterialType::mirror) return reflect(first, direction, flux, paths);
  const SurfacePoint entry{first.position, first.flatPosition, first.normal, first.geometricNormal,
                           first.patch};
  const uint32_t bands = material_.isDispersive() ? 3 : 1;
  for (const uint32_t reflections : reflectionChoices(material_, paths_))
    for (uint32_t band = 0; band < bands; ++band) {
      const OutgoingRay ray = follower_.follow(entry, 0, direction, {}, {band, paths_, reflections});
      if (ray.flags != 0) continue;
      vec3 carried = flux * ray.transmittance;
      for (uint32_t channel = 0; bands == 3 && channel < 3; ++channel)
        if (channel != band) carried[int(channel)] = 0;
      if (carried.x + carried.y + carried.z < kLeastShare * (flux.x + flux.y + flux.z)) continue;
      paths.push_back({ray.position, ray.direction, carried, std::numeric_limits<float>::infinity()});
    }
}

// Of a photon from `start`, in the caster's own space; empty where it meets nothing. `hit` is where it meets
// the caster.
std::vector<PhotonPath> CasterTracer::send(vec3 start, const mat3& frame, vec3 flux, float reach,
                                           Hit& hit) const {
  std::vector<PhotonPath> paths;
  if (!rays_.intersect({start, frame[2]}, hit)) return paths;
  follow(hit, frame[2], flux, paths);
  const mat3 toFrame = glm::transpose(frame);
  for (PhotonPath& path : paths) {
    path.origin = toFrame * ((path.origin - sphere_.center) / sphere_.radius);
    path.direction = toFrame * path.direction;
    path.length = std::min(path.length / sphere_.radius, lengthInside(path.origin, path.direction, reach));
  }
  std::erase_if(paths, [](const PhotonPath& path) { return path.length <= 0; });
  return paths;
}

std::vector<PhotonPath> CasterTracer::trace(vec3 lightDirection, uint32_t photons, float reach) const {
  return trace(sampleFrame(lightDirection), photons, reach);
}

std::vector<PhotonPath> CasterTracer::trace(const mat3& frame, uint32_t photons, float reach) const {
  const vec3 flux(std::numbers::pi_v<float> / float(photons));
  return inBlocks<PhotonPath>(photons, [&](uint32_t photon, std::vector<PhotonPath>& found) {
    Hit hit;
    const vec3 start = sphere_.center + sphere_.radius * (frame * vec3(onDisc(photon), -2.0f));
    const std::vector<PhotonPath> paths = send(start, frame, flux, reach, hit);
    found.insert(found.end(), paths.begin(), paths.end());
  });
}

std::vector<PhotonPair> CasterTracer::pairs(const mat3& frame, const mat3& other, PairedBy pairedBy,
                                            uint32_t photons, float reach) const {
  constexpr float kSamePlace = 1e-3f;  // bounding radii
  const vec3 flux(std::numbers::pi_v<float> / float(photons));
  return inBlocks<PhotonPair>(photons, [&](uint32_t photon, std::vector<PhotonPair>& found) {
    const vec3 start(onDisc(photon), -2.0f);
    Hit hit, otherHit;
    const std::vector<PhotonPath> from =
        send(sphere_.center + sphere_.radius * (frame * start), frame, flux, reach, hit);
    if (from.empty()) return;
    const vec3 otherStart = pairedBy == PairedBy::place ? sphere_.center + sphere_.radius * (other * start)
                                                        : hit.position - 3 * sphere_.radius * other[2];
    const std::vector<PhotonPath> to = send(otherStart, other, flux, reach, otherHit);
    if (to.size() != from.size()) return;
    if (pairedBy == PairedBy::entry && length(hit.position - otherHit.position) > kSamePlace * sphere_.radius)
      return;
    for (std::size_t i = 0; i < from.size(); ++i) found.push_back({from[i], to[i]});
  });
}

}  // namespace nephroid
