#include "beams/ray_mesh/light_sheets.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "beams/first_cuts.h"
#include "core/index_range.h"
#include "geometry/bounds.h"

namespace nephroid {
namespace {

constexpr std::size_t kGrain = 256;
constexpr uint32_t kMaximumForcedCuts = 7;
// Cosine of the angle (0.8 rad) under which a lamp may see the side of a first sheet, and how often sheets
// are cut for it.
constexpr float kNarrowCosine = 0.7f;
constexpr int kMostWideCuts = 4;
// Nodes that the path of a caster's own corner has, about.
constexpr std::size_t kNodesOfCorner = 8;
// Of the paths and sheets that a caster's triangle has, about.
constexpr std::size_t kBytesOfTriangle = 3000;
// Of the memory: while paths take less, sheets are cut ahead.
constexpr float kPartAhead = 0.2f;
// By how much a single path stands for light of a wider beam at each boundary that it passes.
constexpr float kSpreadAtBoundary = 2.0f;

// Whether the three paths of a sheet are one way.
bool isOneWay(const std::vector<PathNode>& nodes, const Sheet& sheet) {
  const PathNode &a = nodes[sheet.node[0]], &b = nodes[sheet.node[1]], &c = nodes[sheet.node[2]];
  return a.signature == b.signature && a.signature == c.signature && a.generation == b.generation &&
         a.generation == c.generation;
}

}  // namespace

void SheetMemory::giveBackLarge() {
  constexpr std::size_t kLarge = (16 << 20) / sizeof(Sheet);
  for (std::vector<Sheet>* list : {&sheets, &next, &mixed, &landed, &worst})
    if (list->empty() && list->capacity() > kLarge) *list = {};
}

LightSheets::LightSheets(const Scene& sceneOf, const RayScene& rayScene, const RayMeshSettings& settingsOf,
                         std::span<const CasterLight> lightsOf, MediaTable& media, SheetMemory& memoryOf)
    : tree(sceneOf, rayScene, settingsOf.paths, settingsOf.target, media),
      scales(sceneOf, settingsOf),
      scene_(sceneOf),
      rays_(rayScene),
      settings_(settingsOf),
      lights_(lightsOf),
      memory_(memoryOf),
      pending_(memoryOf.pending),
      firstOfCorner_(memoryOf.firstOfCorner),
      middles_(memoryOf.middles) {
  pending_.clear();
  firstOfCorner_.clear();
  middles_.resize(lights_.size());
  for (EdgeTable& table : middles_) table.clear();
  rims_.resize(scene_.meshes.size());
  for (const CasterLight& light : lights_) {
    tree.hasSpreads = tree.hasSpreads || light.spread.hasSize();
    const uint32_t mesh = scene_.objects[light.object].mesh;
    if (!rims_[mesh]) rims_[mesh].emplace(scene_.meshes[mesh]);
  }
}

std::vector<std::span<const CasterLight>> lightGroups(const Scene& scene, std::span<const CasterLight> lights,
                                                      uint64_t mostBytes) {
  std::vector<std::span<const CasterLight>> groups;
  std::size_t first = 0;
  uint64_t bytes = 0;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const uint64_t own = kBytesOfTriangle * scene.meshOf(scene.objects[lights[i].object]).triangles.size();
    if (i > first && bytes + own > mostBytes) {
      groups.push_back(lights.subspan(first, i - first));
      first = i;
      bytes = 0;
    }
    bytes += own;
  }
  if (first < lights.size()) groups.push_back(lights.subspan(first));
  return groups;
}

uint32_t LightSheets::addCorner(const NewCorner& corner) {
  pending_.push_back(corner);
  firstOfCorner_.push_back(kNone);
  return uint32_t(firstOfCorner_.size() - 1);
}

void LightSheets::settleCorners() {
  const std::size_t count = pending_.size();
  const uint32_t firstCorner = uint32_t(firstOfCorner_.size() - count);
  std::vector<PathNode> begun(count);
  const bool mayTouch = !rays_.contacts().areNone();
  std::vector<Hit> places(mayTouch ? count : 0);
  oneapi::tbb::parallel_for(IndexRange(0, count, kGrain), [&](const IndexRange& range) {
    std::vector<Ray> toLight;
    std::vector<uint8_t> isDark(range.size());
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const NewCorner& at = pending_[i];
      const CasterLight& light = lights_[at.light];
      const uint32_t mesh = scene_.objects[light.object].mesh;
      const vec2 weights = rims_[mesh]->movedOff(scene_.meshes[mesh], at.triangle, at.weights);
      const EntryPoint entry = entryPoint(scene_, rays_, light.object, at.triangle, weights);
      begun[i] = firstNode(light, entry, firstCorner + uint32_t(i));
      if (mayTouch) places[i] = placeOf(entry, light.object, at.triangle, begun[i].direction, rays_);
      const float far = light.emitter.type == kEmitterDirectional ? std::numeric_limits<float>::infinity()
                                                                  : begun[i].length;
      const vec3 direction = -begun[i].direction;
      const float near = rays_.clearance(light.object, entry.geometricNormal, direction);
      toLight.push_back({entry.flatPosition, direction, near, beforeLamp(far)});
    }
    rays_.occluded(toLight, isDark);
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      // Of surfaces that lie in the same place light meets one.
      const bool isOthers = mayTouch && places[i].object != begun[i].object;
      if (isDark[i - range.begin()] || isOthers) begun[i].state = PathState::dark;
    }
  });
  stats.shadowRays += count;
  for (std::size_t i = 0; i < count; ++i) {
    firstOfCorner_[firstCorner + i] =
        tree.addFirst(begun[i], mayTouch ? places[i].touched() : std::span<const Touching>{});
    const CasterLight& light = lights_[pending_[i].light];
    if (light.spread.hasSize())
      tree.spreads.back() = firstSpread(light.spread, light.emitter.type == kEmitterDirectional,
                                        begun[i].direction, begun[i].length);
  }
  pending_.clear();
}

// All asked for goes on together, boundary by boundary.
void LightSheets::reach(std::vector<PathAsk>& asks) {
  settleCorners();
  uint8_t farthest = 0;
  for (PathAsk& ask : asks) {
    ask.node = firstOfCorner_[ask.corner];
    farthest = std::max(farthest, ask.generation);
  }
  std::vector<uint32_t>&fresh = memory_.fresh, &asked = memory_.asked, &ahead = memory_.ahead;
  for (uint8_t generation = 0; generation < farthest; ++generation) {
    fresh.clear();
    asked.clear();
    ahead.clear();
    for (PathAsk& ask : asks) {
      if (ask.generation <= generation) continue;
      const PathNode& node = tree.nodes[ask.node];
      if (node.state != PathState::atCaster || node.generation != generation) continue;
      const uint8_t wanted = uint8_t(ask.path >> generation & 1u);
      // Where there is one way alone, that one.
      const uint8_t way = tree.waysFrom(node) >> wanted & 1u ? wanted : uint8_t(1 - wanted);
      ask.node = tree.childOf(ask.node, way, fresh);
      asked.push_back(ask.node);
    }
    tree.bend(fresh);
    for (const uint32_t node : asked) tree.queue(node, ahead);
    tree.trace(ahead);
  }
}

vec3 LightSheets::cornerPosition(const Sheet& sheet, vec2 weights) const {
  return entryPosition(scene_, lights_[sheet.light].object, sheet.triangle, weights);
}

vec3 LightSheets::fluxOf(const Sheet& sheet, vec3 a, vec3 b, vec3 c) const {
  return sheet.gain * fluxBetween(scene_, lights_[sheet.light], a, b, c);
}

vec3 LightSheets::fluxOf(const Sheet& sheet) const {
  return fluxOf(sheet, cornerPosition(sheet, sheet.weights[0]), cornerPosition(sheet, sheet.weights[1]),
                cornerPosition(sheet, sheet.weights[2]));
}

// lm onto each of its caster's triangles.
std::vector<vec3> LightSheets::fluxesOntoTriangles(const CasterLight& light) const {
  const Object& object = scene_.objects[light.object];
  const Mesh& mesh = scene_.meshOf(object);
  std::vector<vec3> positions(mesh.positions.size()), fluxes(mesh.triangles.size());
  oneapi::tbb::parallel_for(IndexRange(0, positions.size(), 4096), [&](const IndexRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      positions[i] = object.placement.point(mesh.positions[i]);
  });
  oneapi::tbb::parallel_for(IndexRange(0, fluxes.size(), kGrain), [&](const IndexRange& range) {
    for (std::size_t t = range.begin(); t < range.end(); ++t) {
      const uvec3 c = mesh.triangles[t];
      fluxes[t] = fluxBetween(scene_, light, positions[c.x], positions[c.y], positions[c.z]);
    }
  });
  return fluxes;
}

void LightSheets::addFirstSheets(std::vector<Sheet>& sheets) {
  std::vector<Sheet> forced[kMaximumForcedCuts + 1];
  std::vector<uint32_t> cornerOf;
  std::vector<double> lightFluxes(lights_.size());
  for (uint32_t index = 0; index < uint32_t(lights_.size()); ++index) {
    const Mesh& mesh = scene_.meshOf(scene_.objects[lights_[index].object]);
    const float extent = boundingBox(mesh).diagonal();
    cornerOf.assign(mesh.positions.size(), kNone);
    const std::vector<vec3> fluxes = fluxesOntoTriangles(lights_[index]);
    for (uint32_t t = 0; t < fluxes.size(); ++t) {
      if (!(fluxes[t].x + fluxes[t].y + fluxes[t].z > 0)) continue;
      Sheet sheet;
      sheet.triangle = t;
      sheet.light = index;
      sheet.flux = fluxes[t];
      sheet.weights[0] = vec2(0);
      sheet.weights[1] = vec2(1, 0);
      sheet.weights[2] = vec2(0, 1);
      lightFluxes[index] += double(luminanceOf(sheet.flux));
      for (int i = 0; i < 3; ++i) {
        uint32_t& corner = cornerOf[mesh.triangles[sheet.triangle][i]];
        if (corner == kNone) corner = addCorner({index, sheet.triangle, sheet.weights[i]});
        sheet.node[i] = corner;  // until it is settled
      }
      const uint32_t cuts = firstCutsFor(mesh, mesh.triangles[sheet.triangle], extent);
      (cuts == 0 ? sheets : forced[cuts]).push_back(sheet);
    }
  }
  stats.incidentFlux = std::accumulate(lightFluxes.begin(), lightFluxes.end(), 0.0);
  // A list that grows is there twice while it is copied.
  tree.nodes.reserve(kNodesOfCorner * pending_.size());
  settleCorners();
  const auto setNodes = [&](std::vector<Sheet>& some) {
    for (Sheet& sheet : some)
      for (uint32_t& node : sheet.node) node = firstOfCorner_[node];
  };
  setNodes(sheets);
  for (std::vector<Sheet>& some : forced) setNodes(some);
  for (std::size_t cuts = kMaximumForcedCuts; cuts > 0; --cuts) {
    std::vector<Sheet>& parts = cuts == 1 ? sheets : forced[cuts - 1];
    cut(forced[cuts], parts);
    for (Sheet& sheet : parts) sheet.cuts = 0;
  }
  cutWide(sheets);
  firstSheets_ = sheets.size();
  fullFluxes_ = scales.fullFluxes(lights_, lightFluxes);
}

// Those that a lamp close by sees under a wide angle.
void LightSheets::cutWide(std::vector<Sheet>& sheets) {
  const auto isWide = [&](const Sheet& sheet) {
    const auto direction = [&](int i) { return tree.nodes[sheet.node[i % 3]].direction; };
    for (int i = 0; i < 3; ++i)
      if (dot(direction(i), direction(i + 1)) < kNarrowCosine) return true;
    return false;
  };
  for (int round = 0; round < kMostWideCuts; ++round) {
    if (std::ranges::none_of(sheets, isWide)) return;
    const auto narrow = std::stable_partition(sheets.begin(), sheets.end(),
                                              [&](const Sheet& sheet) { return !isWide(sheet); });
    const std::vector<Sheet> wide(narrow, sheets.end());
    const std::size_t kept = std::size_t(narrow - sheets.begin());
    sheets.resize(kept);
    cut(wide, sheets);
    for (std::size_t i = kept; i < sheets.size(); ++i) sheets[i].cuts = 0;
  }
}

void LightSheets::cut(std::span<const Sheet> sheets, std::vector<Sheet>& parts) {
  if (sheets.empty()) return;
  std::vector<PathAsk>& asks = memory_.cutAsks;
  asks.clear();
  for (const Sheet& sheet : sheets)
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const uint32_t a = tree.nodes[sheet.node[i]].corner, b = tree.nodes[sheet.node[j]].corner;
      uint32_t& middle = middles_[sheet.light].at(a, b);
      if (middle == EdgeTable::kEmpty)
        middle = addCorner({sheet.light, sheet.triangle, 0.5f * (sheet.weights[i] + sheet.weights[j])});
      asks.push_back({middle, sheet.path, sheet.generation});
    }
  reach(asks);
  const std::size_t first = parts.size();
  parts.resize(first + 4 * sheets.size());
  oneapi::tbb::parallel_for(IndexRange(0, sheets.size(), kGrain), [&](const IndexRange& range) {
    for (std::size_t s = range.begin(); s < range.end(); ++s) {
      const Sheet& whole = sheets[s];
      uint32_t node[6];
      vec2 weights[6];
      for (int i = 0; i < 3; ++i) {
        node[i] = whole.node[i];
        weights[i] = whole.weights[i];
        node[3 + i] = asks[3 * s + i].node;
        weights[3 + i] = 0.5f * (whole.weights[i] + whole.weights[(i + 1) % 3]);
      }
      float bend = isOneWay(tree.nodes, whole) ? 0.0f : kUnknownBend;
      if (bend == 0)
        for (int i = 0; i < 3; ++i)
          bend = std::max(
              bend, length(tree.nodes[node[3 + i]].position -
                           0.5f * (tree.nodes[node[i]].position + tree.nodes[node[(i + 1) % 3]].position)));
      vec3 corners[6];
      for (int i = 0; i < 6; ++i) corners[i] = cornerPosition(whole, weights[i]);
      constexpr int kParts[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
      for (int p = 0; p < 4; ++p) {
        Sheet& part = parts[first + 4 * s + p];
        part = whole;
        part.cuts = uint8_t(whole.cuts + 1);
        part.bend = bend == kUnknownBend ? bend : 0.25f * bend;
        for (int i = 0; i < 3; ++i) {
          part.node[i] = node[kParts[p][i]];
          part.weights[i] = weights[kParts[p][i]];
        }
        part.flux = fluxOf(part, corners[kParts[p][0]], corners[kParts[p][1]], corners[kParts[p][2]]);
      }
    }
  });
}

// Of the memory, the part that paths take, whatever lists were made for pictures before.
float LightSheets::partOfMemory() const {
  const std::size_t used = tree.nodes.size() * sizeof(PathNode) + tree.spreads.size() * sizeof(PathSpread);
  return float(used) / float(settings_.mostBytes);
}

std::size_t LightSheets::bytes() const {
  std::size_t sum = tree.nodes.capacity() * sizeof(PathNode) + tree.spreads.capacity() * sizeof(PathSpread) +
                    firstOfCorner_.capacity() * sizeof(uint32_t);
  for (const EdgeTable& table : middles_) sum += table.bytes();
  for (const std::vector<Sheet>* list :
       {&memory_.sheets, &memory_.next, &memory_.mixed, &memory_.landed, &memory_.worst})
    sum += list->capacity() * sizeof(Sheet);
  return sum;
}

// A path that ends early belongs to all sheets that differ only in the ways they would have taken after its
// end. The sheet of the first ways alone counts its light. True for the others.
bool LightSheets::isElsewhere(const Sheet& sheet) const {
  const uint8_t ended = tree.nodes[sheet.node[0]].generation;
  return ended < sheet.generation && (sheet.aside >> ended) != 0;
}

bool LightSheets::isFacetedAt(const PathNode& node) const {
  return node.object != kNone && scene_.meshOf(scene_.objects[node.object]).isFaceted();
}

void LightSheets::follow(std::vector<Sheet>& sheets, std::vector<Sheet>& landed, Progress& progress) {
  std::vector<Sheet>&mixed = memory_.mixed, &next = memory_.next;
  std::vector<Sheet> tooLong, early;
  while (!sheets.empty()) {
    progress.advance();
    mixed.clear();
    tooLong.clear();
    early.clear();
    next.clear();
    memory_.fresh.clear();
    const bool hasRoom = partOfMemory() < kPartAhead;
    for (const Sheet& sheet : sheets) {
      if (!isOneWay(tree.nodes, sheet)) {
        mixed.push_back(sheet);
        continue;
      }
      const PathNode& node = tree.nodes[sheet.node[0]];
      if (node.state == PathState::atCaster && node.generation >= kMostOfSheet && sheet.cuts != kWhole) {
        tooLong.push_back(sheet);
      } else if (hasRoom && node.state == PathState::atCaster && isCutAhead(sheet)) {
        early.push_back(sheet);
      } else if (node.state == PathState::atCaster) {
        expand(sheet, next);
      } else if (isElsewhere(sheet)) {
        continue;
      } else if (node.state == PathState::arrived) {
        landed.push_back(sheet);
      } else if (node.state == PathState::lost) {
        stats.lostFlux += double(luminanceOf(carried(sheet)));
      } else if (node.state == PathState::dark) {
        stats.shadedFlux += double(luminanceOf(carried(sheet)));
      } else if (node.state == PathState::missed) {
        stats.missedFlux += double(luminanceOf(carried(sheet)));
      }
    }
    traceChildren(next);
    cut(early, next);
    part(mixed, next);
    giveToOnes(tooLong, next);
    sheets.swap(next);
  }
  mixed.clear();
  next.clear();
  memory_.giveBackLarge();
}

// Its children's paths are new, to be bent and traced.
void LightSheets::expand(const Sheet& sheet, std::vector<Sheet>& children) {
  const PathNode& node = tree.nodes[sheet.node[0]];
  const uint32_t ways = tree.waysFrom(node);
  // A sheet whose paths turned out to be at an earlier boundary goes on from there.
  const uint8_t generation = node.generation;
  const float spread = isFacetedAt(node) ? 1 : kSpreadAtBoundary;
  for (const uint8_t way : {kTransmitted, kReflected}) {
    if (!(ways >> way & 1u)) continue;
    if (generation < sheet.generation && uint8_t(sheet.path >> generation & 1u) != way && ways == 3u)
      continue;
    Sheet& child = children.emplace_back(sheet);
    child.generation = uint8_t(generation + 1);
    if (generation < kMostOfSheet) {
      const uint64_t below = (uint64_t{1} << generation) - 1;
      child.path = (sheet.path & below) | uint64_t(way) << generation;
      const bool isFirst = way == kTransmitted || !(ways & 1u);
      child.aside = (sheet.aside & below) | uint64_t(!isFirst) << generation;
    }
    if (sheet.cuts == kWhole) {
      child.node[0] = child.node[1] = child.node[2] = tree.childOf(sheet.node[0], way, memory_.fresh);
      child.bend *= spread;
    } else {
      for (uint32_t& at : child.node) at = tree.childOf(at, way, memory_.fresh);
    }
  }
}

// Those that are worth it; the others are left out.
void LightSheets::traceChildren(std::vector<Sheet>& children) {
  tree.bend(memory_.fresh);
  prune(children);
  chooseAmongWeak(children);
  std::vector<uint32_t>& ahead = memory_.ahead;
  ahead.clear();
  for (const Sheet& child : children)
    for (const uint32_t node : child.node) tree.queue(node, ahead);
  tree.trace(ahead);
}

}  // namespace nephroid
