#include "techniques/adaptive_beams/cell_tree.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace nephroid {
namespace {

// A beam is added to cells that are so many levels finer than its own, and carried from there.
constexpr uint32_t kLevelsBelow = 3;
// What lies on several objects in one cell is parted by cells up to so many levels finer.
constexpr uint32_t kLevelsToPart = 3;
// The light of single paths is faint and wide.
constexpr uint32_t kLevelsToPartPaths = 1;
constexpr std::size_t kChunk = 2048;  // beams that one task takes

uint64_t packed(uvec3 at) {
  return uint64_t(at.x) | uint64_t(at.y) << 21 | uint64_t(at.z) << 42;
}

}  // namespace

CellTree::CellTree(LandedLight& light, const RayMesh& mesh, const std::vector<FacedBeam>& faced)
    : light_(light), mesh_(mesh), faced_(faced) {
  const LandedGrid grid = light_.grid;
  const uvec3 n = grid.cells;
  light_.cells.assign(std::size_t(kFaces) * n.x * n.y * n.z, {});
  places.resize(light_.cells.size());
  for (uint32_t face = 0; face < kFaces; ++face)
    for (uint32_t z = 0; z < n.z; ++z)
      for (uint32_t y = 0; y < n.y; ++y)
        for (uint32_t x = 0; x < n.x; ++x)
          places[rootOf(grid, face, {x, y, z})] = {
              grid.origin + grid.cellSize * vec3(float(x), float(y), float(z)), grid.cellSize, uint8_t(face),
              0};

  bounds_.resize(faced_.size());
  oneapi::tbb::parallel_for(std::size_t{0}, (faced_.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t end = std::min(faced_.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) bounds_[i] = boundsOf(faced_[i]);
  });
  addCells(requestedBy([&](const FacedBeam& one, const Bounds& bounds, CellRequests& asked) {
    const float size = sizeAt(one.level);
    forCells(bounds, one.level, [&](uvec3 at) {
      if (bounds.meets(grid.origin + size * vec3(at), size))
        asked.add({one.level, one.face, packed(at), mesh_.beams[one.beam].object});
    });
  }));
  for (uint32_t round = 0; round < kLevelsToPart && markShared(); ++round)
    addCells(requestedBy([&](const FacedBeam& one, const Bounds& bounds, CellRequests& asked) {
      forCells(bounds, one.level, [&](uvec3 at) { askWithin(cellAt(one, at), at, one, bounds, asked); });
    }));
}

// For the cells within shared ones, where they are not yet there.
void CellTree::askWithin(uint32_t cell, uvec3 at, const FacedBeam& faced, const Bounds& bounds,
                         CellRequests& asked) const {
  const CellPlace& place = places[cell];
  const uint32_t toPart = mesh_.beams[faced.beam].isPath ? kLevelsToPartPaths : kLevelsToPart;
  if (!place.isShared || place.level < faced.level || place.level >= faced.level + toPart) return;
  for (uint32_t octant = 0; octant < 8; ++octant) {
    const CellPlace child = childPlace(cell, octant);
    if (!bounds.meets(child.low, child.size)) continue;
    const uvec3 there = 2u * at + uvec3(octant & 1u, octant >> 1 & 1u, octant >> 2);
    asked.add({child.level, faced.face, packed(there), mesh_.beams[faced.beam].object});
    if (const uint32_t known = light_.cells[cell].children[octant])
      askWithin(known, there, faced, bounds, asked);
  }
}

// What lies one behind the other on several objects is parted by finer cells. Whether there is any.
bool CellTree::markShared() {
  std::vector<uint32_t> within(places.size(), kNone);  // the object of a cell and of all finer ones within
  bool isAny = false;
  for (std::size_t cell = places.size(); cell-- > 0;) {
    const auto include = [&](uint32_t object) {
      if (object != kNone) within[cell] = within[cell] == kNone || within[cell] == object ? object : kMany;
    };
    include(places[cell].object);
    for (const uint32_t child : light_.cells[cell].children)
      if (child != 0) include(within[child]);
    places[cell].isShared = places[cell].object != kNone && within[cell] == kMany;
    isAny = isAny || places[cell].isShared;
  }
  return isAny;
}

bool CellTree::Bounds::meets(vec3 low, float size) const {
  if (glm::any(glm::lessThan(box.high, low)) || glm::any(glm::greaterThan(box.low, low + size))) return false;
  const vec3 middle = low + 0.5f * size, half = vec3(0.5f * size) + spare;
  if (std::abs(dot(middle - corner, normal)) > dot(abs(normal), half)) return false;
  const vec2 place = acrossFace(middle, face), about = acrossFace(half, face);
  for (int i = 0; i < 3; ++i)
    if (dot(outward[i], place) - dot(abs(outward[i]), about) > farthest[i]) return false;
  return true;
}

CellTree::Bounds CellTree::boundsOf(const FacedBeam& faced) const {
  const LandedBeam& beam = mesh_.beams[faced.beam];
  Bounds bounds;
  for (const vec3& corner : beam.corner) bounds.box.include(corner);
  const float texel = sizeAt(faced.level) / float(kTileTexels);
  // A texel about each tile; and surfaces bend between the corners of a beam.
  bounds.spare = vec3(texel);
  bounds.spare[faced.face / 2] = 0.1f * beam.width + 0.5f * texel;
  bounds.box.low -= bounds.spare;
  bounds.box.high += bounds.spare;
  const vec3 across = cross(beam.corner[1] - beam.corner[0], beam.corner[2] - beam.corner[0]);
  const float doubled = length(across);
  if (doubled > 0) bounds.normal = across / doubled;
  bounds.corner = beam.corner[0];
  bounds.face = faced.face;
  vec2 at[3];
  for (int i = 0; i < 3; ++i) at[i] = acrossFace(beam.corner[i], faced.face);
  const float turn = doubledArea(at[0], at[1], at[2]) < 0 ? -1.0f : 1.0f;
  for (int i = 0; i < 3; ++i) {
    const vec2 side = at[(i + 1) % 3] - at[i];
    bounds.outward[i] = turn * vec2(side.y, -side.x);
    bounds.farthest[i] = dot(bounds.outward[i], at[i]);
  }
  return bounds;
}

template <class Visit>
void CellTree::forCells(const Bounds& bounds, uint32_t level, const Visit& visit) const {
  const LandedGrid& grid = light_.grid;
  const float perCell = 1 / sizeAt(level);
  const vec3 most = vec3(grid.cells << level) - 1.0f;
  const uvec3 from(glm::clamp((bounds.box.low - grid.origin) * perCell, vec3(0), most));
  const uvec3 to(glm::clamp((bounds.box.high - grid.origin) * perCell, vec3(0), most));
  for (uint32_t z = from.z; z <= to.z; ++z)
    for (uint32_t y = from.y; y <= to.y; ++y)
      for (uint32_t x = from.x; x <= to.x; ++x) visit(uvec3(x, y, z));
}

// The cell of the beam's own level there; a coarser one where there is none so fine.
uint32_t CellTree::cellAt(const FacedBeam& faced, uvec3 at) const {
  uint32_t cell = rootOf(light_.grid, faced.face, at >> uint32_t(faced.level));
  for (uint32_t level = faced.level; level-- > 0;) {
    const uvec3 half = at >> level & 1u;
    const uint32_t child = light_.cells[cell].children[half.x | half.y << 1 | half.z << 2];
    if (child == 0) break;
    cell = child;
  }
  return cell;
}

// What ask(beam, bounds, asked) adds to its list for all beams: sorted, each once.
template <class Ask>
std::vector<CellTree::CellRequest> CellTree::requestedBy(const Ask& ask) const {
  std::vector<std::vector<CellRequest>> chunks((faced_.size() + kChunk - 1) / kChunk);
  const auto sortOut = [](std::vector<CellRequest>& some) {
    std::sort(some.begin(), some.end());
    some.erase(std::unique(some.begin(), some.end()), some.end());
  };
  oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t chunk) {
    const std::size_t end = std::min(faced_.size(), (chunk + 1) * kChunk);
    CellRequests asked;
    for (std::size_t i = chunk * kChunk; i < end; ++i) ask(faced_[i], bounds_[i], asked);
    sortOut(asked.requests);
    chunks[chunk] = std::move(asked.requests);
  });
  std::vector<CellRequest> all;
  for (const auto& chunk : chunks) all.insert(all.end(), chunk.begin(), chunk.end());
  sortOut(all);
  return all;
}

void CellTree::addCells(const std::vector<CellRequest>& requests) {
  for (const CellRequest& request : requests) addCell(request);
}

// And those about it.
void CellTree::addCell(const CellRequest& request) {
  const uvec3 at = request.at();
  uint32_t cell = rootOf(light_.grid, request.face, at >> uint32_t(request.level));
  for (uint32_t level = request.level; level-- > 0;) {
    const uvec3 half = at >> level & 1u;
    const uint32_t octant = half.x | half.y << 1 | half.z << 2;
    uint32_t child = light_.cells[cell].children[octant];
    if (child == 0) {
      child = uint32_t(light_.cells.size());
      light_.cells[cell].children[octant] = child;
      light_.cells.emplace_back();
      places.push_back(childPlace(cell, octant));
    }
    cell = child;
  }
  uint32_t& object = places[cell].object;
  object = object == kNone || object == request.object ? request.object : kMany;
}

CellPlace CellTree::childPlace(uint32_t cell, uint32_t octant) const {
  const CellPlace& place = places[cell];
  const float half = 0.5f * place.size;
  CellPlace child{place.low, half, place.face, uint8_t(place.level + 1), cell};
  child.low += half * vec3(float(octant & 1u), float(octant >> 1 & 1u), float(octant >> 2 & 1u));
  return child;
}

void CellTree::placeIn(uint32_t cell, uint32_t index, const Bounds& bounds,
                       std::vector<PlacedBeam>& placed) const {
  const CellPlace& place = places[cell];
  if (!bounds.meets(place.low, place.size)) return;
  const FacedBeam& faced = faced_[index];
  const LandedBeam& beam = mesh_.beams[faced.beam];
  const uint32_t toPart = beam.isPath ? kLevelsToPartPaths : kLevelsToPart;
  const uint32_t below = place.isShared ? toPart : (beam.isPath ? 0 : kLevelsBelow);
  const auto& children = light_.cells[cell].children;
  const bool isFinest = std::ranges::all_of(children, [](uint32_t child) { return child == 0; });
  if (isFinest || place.level >= faced.level + below) {
    placed.push_back({cell, index, !isFinest});
    return;
  }
  // Its own tile is read where there are no finer cells.
  bool isOwn = false;
  for (uint32_t octant = 0; octant < 8; ++octant) {
    if (children[octant] != 0) {
      placeIn(children[octant], index, bounds, placed);
    } else if (!isOwn) {
      const CellPlace child = childPlace(cell, octant);
      isOwn = bounds.meets(child.low, child.size);
    }
  }
  if (isOwn) placed.push_back({cell, index, false});
}

std::vector<PlacedBeam> CellTree::place() const {
  std::vector<std::vector<PlacedBeam>> chunks((faced_.size() + kChunk - 1) / kChunk);
  oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t chunk) {
    const std::size_t end = std::min(faced_.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      const Bounds& bounds = bounds_[i];
      forCells(bounds, faced_[i].level, [&](uvec3 at) {
        const uint32_t cell = cellAt(faced_[i], at);
        if (places[cell].level == faced_[i].level) placeIn(cell, uint32_t(i), bounds, chunks[chunk]);
      });
    }
  });
  std::vector<std::size_t> firstOf(places.size() + 1, 0);
  for (const auto& chunk : chunks)
    for (const PlacedBeam& one : chunk) ++firstOf[one.cell + 1];
  for (std::size_t i = 0; i < places.size(); ++i) firstOf[i + 1] += firstOf[i];
  std::vector<PlacedBeam> placed(firstOf.back());
  for (const auto& chunk : chunks)
    for (const PlacedBeam& one : chunk) placed[firstOf[one.cell]++] = one;
  return placed;
}

}  // namespace nephroid
