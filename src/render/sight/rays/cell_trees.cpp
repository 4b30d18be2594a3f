#include "render/sight/rays/cell_trees.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/color.h"

namespace nephroid {
namespace {

constexpr std::size_t kChunk = 64;  // trees that one task traces

// What interpolation may be off in a cell's middle: parts of a pixel where the ray ends, at full weight and
// at least weight; of a weight, and absolutely; of a unit normal.
constexpr float kMostShift = 0.2f, kMostFaintShift = 2;
constexpr float kMostWeightError = 0.004f, kMostFaintError = 5e-4f;
constexpr float kMostTurn = 0.01f;
constexpr float kRoundedTexcoord = 1e-5f;
// What faint ways may show of the sky in all, of the sky's mean: they are those of a corner and would be seen
// as squares. Small lights are looked for so widely (radians).
constexpr float kMostFaintSky = 0.02f;
constexpr float kWideLook = 0.1f;

}  // namespace

CellTrees::CellTrees(const RaySightInput& input, const CasterRays& rays)
    : in_(input),
      rays_(rays),
      tracer_(input.scene, input.rays, input.materials, input.trees),
      meanSky_(input.trees.tellsSky ? luminanceOf(input.skies->mean()) : 0),
      treeOf_(rays.size(), kNone),
      isBetween_(std::size_t(rays.cells().x) * rays.cells().y, 0) {
  if (input.interpolates) {
    traceCells(&CellTrees::listCorners);
    traceCells(&CellTrees::listMiddle);
    keepAgreeing();
  }
  traceCells(&CellTrees::listOthers);
}

// Traces what `list` adds to a list for each cell.
void CellTrees::traceCells(List list) {
  std::vector<uint32_t> all;
  for (const uvec2 cell : rays_.cellsOfTiles()) (this->*list)(cell, all);
  const std::size_t firstChunk = chunks_.size();
  chunks_.resize(firstChunk + (all.size() + kChunk - 1) / kChunk);
  for (std::size_t i = 0; i < all.size(); ++i) treeOf_[all[i]] = uint32_t(firstChunk * kChunk + i);
  oneapi::tbb::parallel_for(firstChunk, chunks_.size(), [&](std::size_t chunk) {
    const std::size_t low = (chunk - firstChunk) * kChunk;
    const std::size_t high = std::min(low + kChunk, all.size());
    thread_local std::vector<Ray> rays;
    thread_local std::vector<Hit> hits;
    rays.clear();
    hits.clear();
    for (std::size_t i = low; i < high; ++i) {
      rays.push_back(rays_.rayThrough(rays_.placeOf(all[i])));
      hits.push_back(rays_.hitOf(all[i]));
    }
    tracer_.trace(rays, hits, in_.media, chunks_[chunk]);
  });
}

void CellTrees::add(uvec2 place, std::vector<uint32_t>& list) {
  const uint32_t index = rays_.indexOf(place);
  if (treeOf_[index] != kNone) return;
  treeOf_[index] = 0;  // it is in the list
  list.push_back(index);
}

void CellTrees::listCorners(uvec2 cell, std::vector<uint32_t>& list) {
  if (!rays_.isOfOneSurface(cell)) return;
  for (const uvec2 corner : CasterRays::cornersOf(cell)) add(corner, list);
}

void CellTrees::listMiddle(uvec2 cell, std::vector<uint32_t>& list) {
  const std::array<uvec2, 4> corners = CasterRays::cornersOf(cell);
  const SightTree* first = treeAt(corners[0]);
  for (const uvec2 corner : corners) {
    const SightTree* tree = treeAt(corner);
    if (!tree || tree->ways != first->ways || tree->strong != first->strong) return;
  }
  if (rays_.isOfOneSurface(cell)) add(CasterRays::middleOf(cell), list);
}

void CellTrees::listOthers(uvec2 cell, std::vector<uint32_t>& list) {
  if (isBetween_[cell.y * rays_.cells().x + cell.x]) return;
  const uvec2 low = CasterRays::kCell * cell, high = low + CasterRays::kCell;
  for (uint32_t y = low.y; y < high.y; ++y)
    for (uint32_t x = low.x; x < high.x; ++x)
      if (rays_.isPixel({x, y}) && rays_.isCasterAt({x, y})) add({x, y}, list);
}

const SightTree* CellTrees::treeAt(uvec2 place) const {
  const uint32_t tree = treeOf_[rays_.indexOf(place)];
  return tree == kNone ? nullptr : &chunks_[tree / kChunk].trees[tree % kChunk];
}

const SightEnd* CellTrees::endsAt(uvec2 place) const {
  const SightTrees& chunk = chunks_[treeOf_[rays_.indexOf(place)] / kChunk];
  return chunk.ends.data() + treeAt(place)->first;
}

const WayBeyond& CellTrees::wayBeyondAt(uvec2 place) const {
  const uint32_t tree = treeOf_[rays_.indexOf(place)];
  return chunks_[tree / kChunk].waysBeyond[tree % kChunk];
}

bool CellTrees::isBetween(uvec2 place) const {
  const uvec2 cell = place / CasterRays::kCell;
  return isBetween_[cell.y * rays_.cells().x + cell.x] != 0;
}

Blend CellTrees::blendIn(uvec2 cell, vec2 place) const {
  Blend blend;
  std::size_t i = 0;
  for (const uvec2 corner : CasterRays::cornersOf(cell)) {
    blend.trees[i] = treeAt(corner);
    blend.ends[i++] = endsAt(corner);
  }
  blend.parts = CasterRays::partsAt(place);
  return blend;
}

void CellTrees::keepAgreeing() {
  oneapi::tbb::parallel_for(0u, rays_.cells().y, [&](uint32_t y) {
    for (uint32_t x = 0; x < rays_.cells().x; ++x)
      isBetween_[y * rays_.cells().x + x] = agrees({x, y}) ? 1 : 0;
  });
}

// Whether a cell's middle shows what its corners tell.
bool CellTrees::agrees(uvec2 cell) const {
  const SightTree* middle = treeAt(CasterRays::middleOf(cell));
  if (!middle) return false;
  for (const uvec2 corner : CasterRays::cornersOf(cell))
    if (!treeAt(corner) || treeAt(corner)->ways != middle->ways || treeAt(corner)->strong != middle->strong)
      return false;
  const Blend blend = blendIn(cell, vec2(0.5f));
  const SightEnd* ends = endsAt(CasterRays::middleOf(cell));
  if (largestChannel(glm::abs(blend.background() - middle->background)) >
      kMostWeightError * largestChannel(middle->background) + kFaintWeight)
    return false;
  for (uint32_t i = 0; i < middle->strong; ++i)
    if (!isNear(blend, i, ends[i])) return false;
  if (!in_.trees.tellsSky) return true;
  const std::array<uvec2, 4> corners = CasterRays::cornersOf(cell);
  return !showsFaintSky(CasterRays::middleOf(cell)) &&
         std::ranges::none_of(corners, [&](uvec2 corner) { return showsFaintSky(corner); });
}

// Whether faint ways show enough of the sky to be seen.
bool CellTrees::showsFaintSky(uvec2 place) const {
  const SightTree& tree = *treeAt(place);
  const SightEnd* ends = endsAt(place);
  float sum = 0;
  for (uint32_t i = tree.strong; i < tree.count; ++i)
    if (ends[i].isSky())
      sum += luminanceOf(ends[i].weight * in_.skies->luminance(ends[i].position, kWideLook));
  return sum > kMostFaintSky * meanSky_;
}

bool CellTrees::isNear(const Blend& blend, uint32_t i, const SightEnd& end) {
  const float weight = largestChannel(end.weight);
  if (largestChannel(glm::abs(blend.end(i, &SightEnd::weight) - end.weight)) >
      kMostWeightError * weight + kMostFaintError)
    return false;
  const auto apart = [&](std::size_t a, std::size_t b) {
    return distance(blend.ends[a][i].position, blend.ends[b][i].position);
  };
  const float pixel =
      std::max({apart(0, 1), apart(2, 3), apart(0, 2), apart(1, 3)}) / float(CasterRays::kCell);  // m
  // Where a texture's coordinates begin anew, they jump.
  const auto texelsApart = [&](std::size_t a, std::size_t b) {
    return distance(blend.ends[a][i].texcoord, blend.ends[b][i].texcoord);
  };
  const float texels =
      std::max({texelsApart(0, 1), texelsApart(2, 3), texelsApart(0, 2), texelsApart(1, 3)}) /
      float(CasterRays::kCell);
  const float most =
      kMostShift * glm::clamp(0.1f / std::max(weight, 1e-6f), 1.0f, kMostFaintShift / kMostShift);
  if (distance(blend.end(i, &SightEnd::position), end.position) > most * pixel) return false;
  if (distance(blend.end(i, &SightEnd::texcoord), end.texcoord) > most * texels + kRoundedTexcoord)
    return false;
  return distance(normalize(blend.end(i, &SightEnd::normal)), end.normal) < kMostTurn;
}

void CellTrees::count(RaySightCounts& counts) const {
  for (const SightTrees& chunk : chunks_) {
    counts.rays += chunk.rays;
    counts.traced += chunk.trees.size();
    counts.leftOut += chunk.leftOut;
    counts.lost += chunk.lost;
  }
  if (counts.traced == 0) return;
  counts.leftOut /= double(counts.traced);
  counts.lost /= double(counts.traced);
}

}  // namespace nephroid
