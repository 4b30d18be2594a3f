#include "beams/ray_mesh/path_tree.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>

#include "core/index_range.h"
#include "scene/air.h"
#include "scene/volume.h"
#include "trace/crossing.h"
#include "transport/outgoing_ray.h"

namespace nephroid {
namespace {

constexpr std::size_t kBatch = 128;  // rays_ that are handed to the tracer together

bool entersAt(const PathNode& node) {
  return dot(node.direction, node.geometricNormal) < 0;
}

uint32_t extended(uint32_t signature, uint32_t word) {
  return (signature ^ (word + 0x9e3779b9u)) * 16777619u;  // FNV-1a, a word at a time
}

// `tellsSurface`: whether light that lands on another surface went another way.
uint32_t signatureOf(uint32_t before, const PathNode& node, bool tellsSurface = false) {
  uint32_t signature = before;
  const bool isAtCaster = node.state == PathState::atCaster;
  const bool tellsObject = isAtCaster || node.state == PathState::arrived;
  for (const uint32_t word :
       {uint32_t(node.state), tellsObject ? node.object : 0, isAtCaster || tellsSurface ? node.patch : 0,
        uint32_t(isAtCaster && entersAt(node))})
    signature = extended(signature, word);
  return signature;
}

// The signature that the way from a boundary begins with. What bends by the triangle's own normal parts from
// its neighbors on other triangles; what is totally reflected, from what is reflected in part.
uint32_t beginningOf(const PathNode& from, const PathNode& node) {
  uint32_t signature = from.signature;
  if (node.isTotal) signature = extended(signature, 1);
  if (node.isFlat)
    for (int i = 0; i < 3; ++i)
      signature = extended(signature, std::bit_cast<uint32_t>(from.geometricNormal[i]));
  return signature;
}

}  // namespace

PathTree::PathTree(const Scene& sceneOf, const RayScene& rayScene, Paths pathsOf, const PathTarget& targetOf,
                   MediaTable& media)
    : scene_(sceneOf),
      rays_(rayScene),
      paths_(pathsOf),
      target_(targetOf),
      materials_(materialsOf(sceneOf)),
      mediaTable_(media) {
  constexpr std::size_t kFewTriangles = 128;
  for (const Object& object : sceneOf.objects)
    hasFewFaces_.push_back(sceneOf.meshOf(object).triangles.size() <= kFewTriangles);
}

uint32_t PathTree::waysFrom(const PathNode& node) const {
  const Material& material = *materials_[node.object];
  if (material.type == MaterialType::mirror) return 1u << kReflected;
  if (material.thinWalled || paths_ == Paths::transmission) return 1u << kTransmitted;
  // Inside another object, which fills this place, there is no boundary.
  if (mediaTable_.top(node.before) == mediaTable_.top(node.beyond)) return 1u << kTransmitted;
  return 1u << kTransmitted | 1u << kReflected;
}

uint32_t PathTree::childOf(uint32_t parent, uint8_t way, std::vector<uint32_t>& fresh) {
  const PathNode& from = nodes[parent];
  if (from.child[way] != kNone) return from.child[way];
  const uint32_t index = uint32_t(nodes.size());
  PathNode node;
  node.parent = parent;
  node.corner = from.corner;
  node.channel = from.channel;
  node.generation = uint8_t(from.generation + 1);
  node.way = way;
  node.medium = way == kTransmitted ? from.beyond : from.before;
  nodes[parent].child[way] = index;
  nodes.push_back(node);
  if (hasSpreads) spreads.emplace_back();
  fresh.push_back(index);
  return index;
}

void PathTree::setSides(PathNode& node, std::span<const Touching> touching) {
  const Material& material = *materials_[node.object];
  node.before = node.beyond = node.medium;
  if (material.type != MaterialType::dielectric || material.thinWalled) return;
  const bool enters = entersAt(node);
  const MediaTable::Sides sides = touching.empty()
                                      ? mediaTable_.sidesOf(node.medium, node.object, enters)
                                      : mediaTable_.sidesOf(node.medium, node.object, enters, touching);
  node.before = sides.before;
  node.beyond = sides.beyond;
}

uint32_t PathTree::addFirst(const PathNode& node, std::span<const Touching> touching) {
  nodes.push_back(node);
  if (hasSpreads) spreads.emplace_back();
  PathNode& first = nodes.back();
  setSides(first, touching);
  first.signature = signatureOf(0, first);
  const uint32_t medium = mediaTable_.top(first.medium);
  if (medium != kNone) first.transmittance *= transmittanceOf(*materials_[medium], first.length);
  return uint32_t(nodes.size() - 1);
}

void PathTree::bendOne(PathNode& node) const {
  const PathNode& from = nodes[node.parent];
  const Material& material = *materials_[from.object];
  node.direction = from.direction;
  node.transmittance = from.transmittance;
  if (material.type == MaterialType::mirror) {
    const Reflection reflection = reflectedBy(from.direction, from.normal, from.geometricNormal);
    node.direction = reflection.direction;
    node.isFlat = reflection.isFlat;
    node.transmittance *= material.color;
    return;
  }
  if (material.thinWalled) {
    const vec3 normal = facingNormal(from.direction, from.normal, from.geometricNormal);
    node.transmittance *= thinWallTransmittance(material, node.channel, from.direction, normal);
    return;
  }
  const uint32_t before = mediaTable_.top(from.before), beyond = mediaTable_.top(from.beyond);
  if (before == beyond) return;
  const float eta = iorOf(materials_, before, node.channel) / iorOf(materials_, beyond, node.channel);
  const Bend bend = bendAt(from.direction, from.normal, from.geometricNormal, eta);
  // The same for either way, so that both are parted at the same places and no light is lost between them.
  node.isFlat = bend.isFlat;
  if (node.way == kReflected) {
    node.direction = bend.reflected;
    node.isTotal = bend.reflectance >= 1;
    node.transmittance *= bend.reflectance;
    return;
  }
  node.direction = bend.transmitted;
  node.transmittance *= 1 - bend.reflectance;
  if (bend.reflectance >= 1) {
    node.state = PathState::lost;
    node.signature = signatureOf(from.signature, node);
  }
}

void PathTree::bend(std::span<const uint32_t> fresh) {
  oneapi::tbb::parallel_for(IndexRange(0, fresh.size(), 512), [&](const IndexRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      bendOne(nodes[fresh[i]]);
      if (hasSpreads) spreads[fresh[i]] = bentSpread(nodes[fresh[i]]);
    }
  });
}

// What bendOne does to the direction.
PathSpread PathTree::bentSpread(const PathNode& node) const {
  const PathNode& from = nodes[node.parent];
  PathSpread before = spreads[node.parent], after;
  const vec3 smooth = facingNormal(from.direction, from.normal, from.geometricNormal);
  const float side = dot(from.direction, from.geometricNormal) < 0 ? 1.0f : -1.0f;
  const vec3 normal = node.isFlat ? side * from.geometricNormal : smooth;
  for (vec3& turn : before.normal) turn = node.isFlat ? vec3(0) : dot(smooth, from.normal) < 0 ? -turn : turn;
  const uint32_t inside = mediaTable_.top(from.before), beyond = mediaTable_.top(from.beyond);
  if (node.way == kReflected) {
    reflectSpread(before, from.direction, normal, after);
  } else if (materials_[from.object]->thinWalled || inside == beyond) {
    std::ranges::copy(before.direction, after.direction);
  } else {
    const float eta = iorOf(materials_, inside, node.channel) / iorOf(materials_, beyond, node.channel);
    refractSpread(before, from.direction, normal, eta, after);
  }
  return after;
}

// Of a node that was traced.
void PathTree::carryTo(const PathNode& node, const Hit& hit, PathSpread& spread) const {
  const bool isAtCaster = node.state == PathState::atCaster;
  if (!isAtCaster && node.state != PathState::arrived) return;
  const Mesh& mesh = scene_.meshOf(scene_.objects[node.object]);
  const vec3 normal = !isAtCaster && target_.isPlane ? target_.plane.normal
                      : isAtCaster && mesh.isCurved  ? node.normal
                                                     : node.geometricNormal;
  const float length = glm::distance(nodes[node.parent].position, node.position);
  carrySpread(spreads[node.parent], node.direction, length, normal, spread);
  if (!isAtCaster) return;
  // In the mesh's own space, and back.
  const Placement& placement = scene_.objects[node.object].placement;
  const mat3 toWorld = glm::mat3_cast(placement.rotation), toMesh = transpose(toWorld);
  const uvec3 c = mesh.triangles[hit.triangle];
  PathSpread local;
  for (int i = 0; i < 2; ++i) local.position[i] = toMesh * spread.position[i] / placement.scale;
  turnNormals(mat3(mesh.positions[c.x], mesh.positions[c.y], mesh.positions[c.z]),
              mat3(mesh.normals[c.x], mesh.normals[c.y], mesh.normals[c.z]),
              vec3(1 - hit.barycentric.x - hit.barycentric.y, hit.barycentric), local);
  for (int i = 0; i < 2; ++i) spread.normal[i] = toWorld * local.normal[i];
}

// What is left of light after `length` of the medium that a path is in.
vec3 PathTree::leftAfter(uint16_t medium, vec3 start, vec3 direction, float length) const {
  const uint32_t object = mediaTable_.top(medium);
  if (object != kNone) return transmittanceOf(*materials_[object], length);
  return vec3(scene_.medium ? std::exp(-opticalDepth(*scene_.medium, start, direction, length)) : 1.0f);
}

void PathTree::finish(PathNode& node, const Ray& ray, const Hit& hit) const {
  node.object = hit.object;
  node.length = hit.object == kNone ? kUnboundedReach : hit.distance;
  if (hit.object != kNone && materials_[hit.object]->isCaster()) {
    node.position = hit.position;
    node.flatPosition = hit.flatPosition;
    node.normal = hit.normal;
    node.geometricNormal = hit.geometricNormal;
    node.patch = hit.patch;
    node.transmittance *= leftAfter(node.medium, ray.origin, ray.direction, hit.distance);
    node.state = node.generation < kMostBoundaries ? PathState::atCaster : PathState::lost;
    return;
  }
  const uint32_t medium = mediaTable_.top(node.medium);
  const bool leaked = hit.object == kNone && medium != kNone && rays_.isClosed(medium);
  node.state = PathState::missed;
  if (leaked) {
    node.state = PathState::lost;
  } else if (target_.isPlane) {
    vec2 texel;
    float distance;
    if (!meetPlane(ray.origin, ray.direction, target_.plane, texel, distance)) return;
    // A meter that lies on a receiver is before it, whatever the rounding.
    const float spare =
        2 * rays_.largestRounding() / std::max(dot(ray.direction, target_.plane.normal), 1e-3f);
    if (node.length < distance - spare) return;
    node.position = ray.origin + distance * ray.direction;
    node.transmittance *= leftAfter(node.medium, ray.origin, ray.direction, distance);
    node.object = 0;
    node.state = PathState::arrived;
  } else if (hit.object != kNone) {
    node.position = hit.position;
    node.patch = hit.patch;
    node.normal = hit.normal;
    node.geometricNormal = hit.geometricNormal;
    node.transmittance *= leftAfter(node.medium, ray.origin, ray.direction, hit.distance);
    node.state = PathState::arrived;
  }
}

void PathTree::trace(std::span<const uint32_t> bent) {
  oneapi::tbb::parallel_for(IndexRange(0, bent.size(), kBatch), [&](const IndexRange& range) {
    std::array<Ray, kBatch> batch;
    std::array<Hit, kBatch> hits;
    for (std::size_t first = range.begin(); first < range.end(); first += kBatch) {
      const std::size_t count = std::min(kBatch, range.end() - first);
      for (std::size_t i = 0; i < count; ++i) {
        const PathNode& node = nodes[bent[first + i]];
        const PathNode& from = nodes[node.parent];
        Hit start;
        start.object = from.object;
        start.position = from.position;
        start.flatPosition = from.flatPosition;
        start.geometricNormal = from.geometricNormal;
        batch[i] = rays_.leaving(start, node.direction);
      }
      rays_.intersect(std::span<const Ray>(batch.data(), count), std::span<Hit>(hits.data(), count));
      for (std::size_t i = 0; i < count; ++i) {
        PathNode& node = nodes[bent[first + i]];
        node.isQueued = false;
        finish(node, batch[i], hits[i]);
        if (hits[i].touchingCount > 0)
          joints_.push_back({bent[first + i], hits[i].touching, hits[i].touchingCount});
        if (hasSpreads) carryTo(node, hits[i], spreads[bent[first + i]]);
        const bool tellsSurface =
            node.state == PathState::arrived && !target_.isPlane && hasFewFaces_[node.object];
        node.signature = signatureOf(beginningOf(nodes[node.parent], node), node, tellsSurface);
      }
    }
  });
  raysTraced += bent.size();
  setSidesOf(bent);
}

// In their order, so that media have the same numbers however many threads there are.
void PathTree::setSidesOf(std::span<const uint32_t> traced) {
  for (const uint32_t index : traced)
    if (nodes[index].state == PathState::atCaster) setSides(nodes[index], {});
  if (joints_.empty()) return;
  std::sort(joints_.begin(), joints_.end(), [](const Joint& a, const Joint& b) { return a.node < b.node; });
  for (const Joint& joint : joints_)
    if (nodes[joint.node].state == PathState::atCaster)
      setSides(nodes[joint.node], {joint.touching.data(), joint.count});
  joints_.clear();
}

}  // namespace nephroid
