#include "render/sight/rays/view_tree.h"

#include <algorithm>
#include <bit>

#include "scene/volume.h"
#include "trace/crossing.h"
#include "trace/surface_color.h"

namespace nephroid {
namespace {

constexpr uint32_t kAllChannels = 7;
constexpr float kMostMadeUp = 0.1f;  // of a tree's weight
constexpr float kDarkest =
    1.0f / 16;  // weight of all ways of a tree, as far as its ways are followed further

enum class Event : uint32_t { missed, arrived, mirrored, passed, entered, left, reflected };

uint32_t extended(uint32_t ways, uint32_t word) {
  return (ways ^ (word + 0x9e3779b9u)) * 16777619u;  // FNV-1a, a word at a time
}

uint32_t extended(uint32_t ways, const Hit& hit, Event event) {
  return extended(extended(extended(ways, hit.object), hit.patch), uint32_t(event));
}

// What bends by the triangle's own normal parts from its neighbors on other triangles.
uint32_t extendedByTriangle(uint32_t ways, const Hit& hit) {
  for (int i = 0; i < 3; ++i) ways = extended(ways, std::bit_cast<uint32_t>(hit.geometricNormal[i]));
  return ways;
}

vec3 ofChannels(vec3 weight, uint32_t channels) {
  return {channels & 1u ? weight.x : 0, channels & 2u ? weight.y : 0, channels & 4u ? weight.z : 0};
}

}  // namespace

// A ray on its way, and what it was before.
struct ViewTracer::Branch {
  Ray ray;
  vec3 weight{1};
  float gain = 1;  // of radiance, by the squares of indices, that is in the weight (Veach 1997, 5.2)
  uint32_t tree = 0;
  uint32_t ways = 2166136261u;
  uint32_t crossings = 0;
  bool isBeyond = false;             // it is on the way after the first boundary
  uint32_t channels = kAllChannels;  // bit c: it carries channel c
  MediumStack media;
};

struct ViewTracer::Work {
  std::vector<Branch> wave;  // rays that are near each other follow one another, for the tracer
  std::vector<Branch> transmitted, reflected;  // of the next wave
  std::vector<Branch> weak;   // too weak beside a tree of weight 1, but perhaps not beside their own
  bool hasWeights = false;    // what the trees show but for the weak is known
  std::vector<vec3> weights;  // of each tree's ways that were followed to their ends
  std::vector<vec3> leftOut;  // weights of each tree's ways that were too weak
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  std::vector<SightEnd> ends;  // in the order in which they are met
  std::vector<uint32_t> treeOfEnd;
  SightTrees* result = nullptr;
};

ViewTracer::ViewTracer(const Scene& scene, const RayScene& rays, std::span<const Material* const> materials,
                       const TreeSettings& settings)
    : scene_(scene), rays_(rays), materials_(materials), settings_(settings) {
  for (const Material* material : materials_) extinctions_.push_back(extinctionOf(*material));
}

void ViewTracer::trace(std::span<const Ray> rays, std::span<const Hit> hits, const MediumStack& media,
                       SightTrees& result) const {
  thread_local Work work;
  result = {};
  result.trees.resize(rays.size());
  if (settings_.tellsWaysBeyond) result.waysBeyond.resize(rays.size());
  work.result = &result;
  work.wave.clear();
  work.ends.clear();
  work.treeOfEnd.clear();
  for (uint32_t i = 0; i < rays.size(); ++i) {
    Branch& branch = work.wave.emplace_back();
    branch.ray = rays[i];
    branch.tree = i;
    branch.media = media;
  }
  work.weak.clear();
  work.hasWeights = false;
  work.weights.assign(rays.size(), vec3(0));
  work.leftOut.assign(rays.size(), vec3(0));
  traceWaves(hits, work);
  chooseWeak(work);
  traceWaves(work.hits, work);
  sortEnds(work);
  makeUp(work);
}

void ViewTracer::traceWaves(std::span<const Hit> hits, Work& work) const {
  for (bool isFirst = !work.hasWeights; !work.wave.empty(); isFirst = false) {
    work.transmitted.clear();
    work.reflected.clear();
    for (std::size_t i = 0; i < work.wave.size(); ++i) meet(work.wave[i], hits[i], work);
    work.wave.swap(work.transmitted);
    work.wave.insert(work.wave.end(), work.reflected.begin(), work.reflected.end());
    meetNext(work, isFirst);  // after a boundary or two rays scatter
    hits = work.hits;
  }
}

// What the rays of a wave meet.
void ViewTracer::meetNext(Work& work, bool areAlike) const {
  work.rays.clear();
  for (const Branch& branch : work.wave) work.rays.push_back(branch.ray);
  work.hits.resize(work.wave.size());
  rays_.intersect(work.rays, work.hits, areAlike);
  work.result->rays += work.wave.size();
}

// Of dark trees, the ways that would be too weak in bright ones make the next wave.
void ViewTracer::chooseWeak(Work& work) const {
  work.hasWeights = true;
  for (const Branch& branch : work.weak)
    if (isKept(branch, work))
      work.wave.push_back(branch);
    else
      leaveOut(branch, work);
  meetNext(work, false);
}

// Ends by trees, within each the faint ones last, and otherwise in the order in which they were met.
void ViewTracer::sortEnds(const Work& work) {
  SightTrees& result = *work.result;
  uint32_t first = 0;
  for (SightTree& tree : result.trees) {
    tree.first = first;
    first += tree.count;
    tree.count = tree.strong;
    tree.strong = 0;
  }
  result.ends.resize(work.ends.size());
  for (std::size_t i = 0; i < work.ends.size(); ++i) {
    SightTree& tree = result.trees[work.treeOfEnd[i]];
    uint32_t& next = work.ends[i].isFaint() ? tree.count : tree.strong;
    result.ends[tree.first + next++] = work.ends[i];
  }
}

void ViewTracer::leaveOut(const Branch& branch, Work& work) const {
  const uint32_t medium = branch.media.top();
  // In what absorbs, most of it comes to an end there.
  if (medium == kNone || extinctions_[medium] == vec3(0))
    work.leftOut[branch.tree] += branch.weight / std::min(branch.gain, 1.0f);
  work.result->leftOut += double(largestChannel(branch.weight));
}

// What was left out is taken to show what the tree's other ways show.
void ViewTracer::makeUp(const Work& work) {
  for (std::size_t i = 0; i < work.weights.size(); ++i) {
    SightTree& tree = work.result->trees[i];
    const vec3 factor =
        1.0f + glm::min(work.leftOut[i] / glm::max(work.weights[i], vec3(1e-6f)), vec3(kMostMadeUp));
    tree.background *= factor;
    for (uint32_t end = tree.first; end < tree.first + tree.count; ++end)
      work.result->ends[end].weight *= factor;
  }
}

void ViewTracer::meet(const Branch& arriving, const Hit& hit, Work& work) const {
  SightTree& tree = work.result->trees[arriving.tree];
  Branch branch = arriving;
  if (branch.isBeyond) {
    const float length = hit.object == kNone ? std::numeric_limits<float>::infinity() : hit.distance;
    work.result->waysBeyond[branch.tree] = {branch.ray.origin, branch.ray.direction, length};
    branch.isBeyond = false;
  }
  const uint32_t medium = branch.media.top();
  if (hit.object == kNone) {
    if (largestChannel(branch.weight) >= kFaintWeight)
      tree.ways = extended(tree.ways, extended(branch.ways, uint32_t(Event::missed)));
    if (medium != kNone && rays_.isClosed(medium)) {
      work.result->lost += double(largestChannel(branch.weight));
    } else if (medium == kNone || extinctions_[medium] == vec3(0)) {
      tree.background += branch.weight;
      work.weights[branch.tree] += branch.weight;
      if (settings_.tellsSky) {
        SightEnd end;
        end.position = branch.ray.direction;
        end.weight = branch.weight;
        end.ways = extended(branch.ways, uint32_t(Event::missed));
        addEnd(branch, end, work);
      }
    }
    return;
  }
  if (medium != kNone && extinctions_[medium] != vec3(0))
    branch.weight *= glm::exp(-extinctions_[medium] * hit.distance);
  const Material& material = *materials_[hit.object];
  if (!material.isCaster()) {
    meetReceiver(branch, hit, work);
  } else if (++branch.crossings > kMaximumCrossings) {
    work.result->lost += double(largestChannel(branch.weight));
  } else if (material.type == MaterialType::mirror) {
    meetMirror(branch, hit, work);
  } else if (material.thinWalled) {
    meetThinWall(branch, hit, work);
  } else {
    meetDielectric(branch, hit, work);
  }
}

void ViewTracer::addEnd(const Branch& branch, const SightEnd& end, Work& work) {
  SightTree& tree = work.result->trees[branch.tree];
  ++tree.count;
  if (!end.isFaint()) ++tree.strong;
  work.ends.push_back(end);
  work.treeOfEnd.push_back(branch.tree);
}

void ViewTracer::meetReceiver(const Branch& branch, const Hit& hit, Work& work) const {
  SightEnd end;
  end.position = hit.flatPosition;
  end.normal = dot(branch.ray.direction, hit.geometricNormal) < 0 ? hit.normal : -hit.normal;
  end.weight = branch.weight;
  work.weights[branch.tree] += branch.weight;
  end.texcoord = texcoordAt(scene_, hit);
  end.object = hit.object;
  end.ways = extended(branch.ways, hit, Event::arrived);
  if (!end.isFaint()) {
    SightTree& tree = work.result->trees[branch.tree];
    tree.ways = extended(tree.ways, end.ways);
  }
  addEnd(branch, end, work);
}

void ViewTracer::meetMirror(const Branch& branch, const Hit& hit, Work& work) const {
  const Reflection reflection = reflectedBy(branch.ray.direction, hit.normal, hit.geometricNormal);
  Branch on = branch;
  on.weight *= materials_[hit.object]->color;
  on.ways = extended(on.ways, hit, Event::mirrored);
  if (reflection.isFlat) on.ways = extendedByTriangle(on.ways, hit);
  goOn(on, hit, reflection.direction, work.reflected, work);
}

void ViewTracer::meetThinWall(const Branch& branch, const Hit& hit, Work& work) const {
  const Material& material = *materials_[hit.object];
  const vec3 direction = branch.ray.direction;
  const vec3 normal = facingNormal(direction, hit.normal, hit.geometricNormal);
  vec3 transmitted;
  for (uint32_t c = 0; c < 3; ++c) transmitted[int(c)] = thinWallTransmitted(material, c, direction, normal);
  Branch on = branch;
  on.weight = branch.weight * transmitted * material.color;
  on.ways = extended(branch.ways, hit, Event::passed);
  goOn(on, hit, direction, work.transmitted, work);
  const Reflection reflection = reflectedBy(direction, hit.normal, hit.geometricNormal);
  on.weight = branch.weight * (1.0f - transmitted);
  on.ways = extended(branch.ways, hit, Event::reflected);
  if (reflection.isFlat) on.ways = extendedByTriangle(on.ways, hit);
  goOn(on, hit, reflection.direction, work.reflected, work);
}

void ViewTracer::meetDielectric(const Branch& branch, const Hit& hit, Work& work) const {
  const MediaSides sides = sidesOf(rays_, branch.media, hit, branch.ray.direction);
  const uint32_t here = sides.before.top(), there = sides.beyond.top();
  if (here == there) {  // inside another object, which fills this place
    Branch on = branch;
    on.media = sides.beyond;
    goOn(on, hit, branch.ray.direction, work.transmitted, work);
    return;
  }
  const auto isDispersive = [&](uint32_t object) {
    return object != kNone && materials_[object]->isDispersive();
  };
  vec3 reflected(0);
  if (!std::has_single_bit(branch.channels) && (isDispersive(here) || isDispersive(there))) {
    for (uint32_t c = 0; c < 3; ++c) refract(branch, hit, sides, 1u << c, reflected, work);
  } else {
    refract(branch, hit, sides, branch.channels, reflected, work);
  }
  const Reflection reflection = reflectedBy(branch.ray.direction, hit.normal, hit.geometricNormal);
  Branch on = branch;
  on.media = sides.before;
  on.weight = reflected;
  on.isBeyond = isFirst(branch) && reflected == branch.weight;
  on.ways = extended(branch.ways, hit, Event::reflected);
  if (reflection.isFlat) on.ways = extendedByTriangle(on.ways, hit);
  goOn(on, hit, reflection.direction, work.reflected, work);
}

// Whether it is at its first boundary, and the way beyond is asked for.
bool ViewTracer::isFirst(const Branch& branch) const {
  return settings_.tellsWaysBeyond && branch.crossings == 1;
}

// Sends on what is transmitted in these channels, which have one index of refraction, and adds what is not
// to `reflected`.
void ViewTracer::refract(const Branch& branch, const Hit& hit, const MediaSides& sides, uint32_t channels,
                         vec3& reflected, Work& work) const {
  const uint32_t channel = uint32_t(std::countr_zero(channels));
  const vec3 direction = branch.ray.direction;
  const float eta =
      iorOf(materials_, sides.before.top(), channel) / iorOf(materials_, sides.beyond.top(), channel);
  const Bend bend = bendAt(direction, hit.normal, hit.geometricNormal, eta);
  const vec3 weight = ofChannels(branch.weight, channels);
  reflected += weight * bend.reflectance;
  if (bend.reflectance >= 1) return;
  Branch on = branch;
  on.media = sides.beyond;
  on.channels = channels;
  on.weight = weight * ((1 - bend.reflectance) * eta * eta);
  on.gain *= eta * eta;
  on.isBeyond = isFirst(branch) && channel == 0;
  const bool enters = dot(direction, hit.geometricNormal) < 0;
  on.ways = extended(extended(branch.ways, hit, enters ? Event::entered : Event::left), channels);
  if (bend.isFlat) on.ways = extendedByTriangle(on.ways, hit);
  goOn(on, hit, bend.transmitted, work.transmitted, work);
}

void ViewTracer::goOn(Branch branch, const Hit& hit, vec3 direction, std::vector<Branch>& next,
                      Work& work) const {
  const bool isStrong = isKept(branch, work);
  if (!isStrong && (work.hasWeights || largestChannel(branch.weight) < kDarkest * settings_.leastWeight))
    return leaveOut(branch, work);
  branch.ray = rays_.leavingTriangle(hit, direction);
  (isStrong ? next : work.weak).push_back(branch);
}

// Whether a way counts beside all that its tree shows, or, as long as that is not known, beside a weight of
// 1.
bool ViewTracer::isKept(const Branch& branch, const Work& work) const {
  // What has entered a denser medium may leave it again, and then weighs what it did before.
  const float least = settings_.leastWeight * std::min(branch.gain, 1.0f);
  const vec3 beside = work.hasWeights ? glm::clamp(work.weights[branch.tree], kDarkest, 1.0f) : vec3(1);
  return glm::any(glm::greaterThan(branch.weight, least * beside));
}

}  // namespace nephroid
