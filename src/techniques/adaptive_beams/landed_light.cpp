#include "techniques/adaptive_beams/landed_light.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

#include "core/index_range.h"
#include "geometry/box.h"
#include "techniques/adaptive_beams/cell_tree.h"
#include "techniques/adaptive_beams/tile_deposit.h"

namespace nephroid {
namespace {

constexpr float kRootsAlong = 2;  // coarsest cells along the longest side of what is lit
// Part of a face's normal that receivers may have and still be of another face nearby.
constexpr float kLeastFacing = 0.5f;

// In parallel, for the beams of each cell.
template <class Add>
void forCells(const std::vector<PlacedBeam>& placed, const Add& add) {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < placed.size(); ++i)
    if (i == 0 || placed[i].cell != placed[i - 1].cell) starts.push_back(i);
  starts.push_back(placed.size());
  oneapi::tbb::parallel_for(std::size_t{0}, starts.size() - 1, [&](std::size_t i) {
    add(std::span(placed).subspan(starts[i], starts[i + 1] - starts[i]));
  });
}

// What beams land on which faces, and how fine the cells are that they ask for. `coarsest`: m, texels of the
// coarsest cells.
std::vector<FacedBeam> facedBeams(const RayMesh& mesh, float coarsest) {
  constexpr std::size_t kChunk = 4096;
  std::vector<std::vector<FacedBeam>> chunks((mesh.beams.size() + kChunk - 1) / kChunk);
  oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t chunk) {
    const std::size_t end = std::min(mesh.beams.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      const LandedBeam& beam = mesh.beams[i];
      const float level = std::round(std::log2(coarsest / beam.texel));
      const uint8_t depth = uint8_t(glm::clamp(level, 0.0f, float(kDeepestCell)));
      for (uint8_t face = 0; face < kFaces; ++face) {
        const int axis = face / 2;
        const float most = face & 1u ? -beam.leastNormal[axis] : beam.mostNormal[axis];
        if (most > kLeastFacing) chunks[chunk].push_back({uint32_t(i), face, depth});
      }
    }
  });
  std::vector<FacedBeam> faced;
  for (const auto& chunk : chunks) faced.insert(faced.end(), chunk.begin(), chunk.end());
  return faced;
}

// Adds to a plane of a tile what a coarser one has there, whose texel `offset` (without its border) is the
// tile's first: at quarters between the coarse texels' middles.
void addCoarser(std::span<const float> coarse, vec2 offset, std::span<float> tile) {
  const std::size_t firstColumn = std::size_t(offset.x), firstRow = std::size_t(offset.y);
  for (std::size_t y = 0; y < kTileStride; ++y) {
    const std::size_t row = firstRow + y / 2;  // the upper of the two
    const float lower = y % 2 == 0 ? 0.25f : 0.75f;
    float between[kTileTexels / 2 + 2];
    for (std::size_t x = 0; x < kTileTexels / 2 + 2; ++x) {
      const float* at = coarse.data() + row * kTileStride + firstColumn + x;
      between[x] = (1 - lower) * at[0] + lower * at[kTileStride];
    }
    for (std::size_t x = 0; x < kTileStride; ++x) {
      const float right = x % 2 == 0 ? 0.25f : 0.75f;
      tile[y * kTileStride + x] += (1 - right) * between[x / 2] + right * between[x / 2 + 1];
    }
  }
}

}  // namespace

void LandedLight::build(const RayMesh& mesh) {
  cells.clear();
  texels.clear();
  Box box;
  for (const LandedBeam& beam : mesh.beams)
    for (const vec3& corner : beam.corner) box.include(corner);
  if (mesh.beams.empty()) {
    grid = {};
    return;
  }
  const vec3 extent = max(box.high - box.low, vec3(1e-6f));
  const float longest = std::max({extent.x, extent.y, extent.z});
  grid.cellSize = longest / kRootsAlong;
  // Off round numbers, where receivers lie.
  grid.origin = box.low - grid.cellSize * vec3(0.4142f, 0.4721f, 0.4453f);
  grid.cells = uvec3(extent / grid.cellSize + 2.0f);
  const std::vector<FacedBeam> faced = facedBeams(mesh, grid.cellSize / float(kTileTexels));
  const CellTree tree(*this, mesh, faced);
  const std::vector<PlacedBeam> placed = tree.place();
  giveTiles(tree, placed);
  const auto addBeams = [&](bool areCarried) {
    forCells(placed, [&](std::span<const PlacedBeam> ofCell) {
      const CellPlace& place = tree.places[ofCell.front().cell];
      const float scale = float(kTileTexels) / place.size;
      const vec2 corner = acrossFace(place.low, place.face);
      const uint32_t cell = ofCell.front().cell;
      if (std::ranges::none_of(ofCell, [&](const PlacedBeam& one) { return one.isCarried == areCarried; }))
        return;
      thread_local TileDeposit deposit;
      deposit.begin(uvec2(kTileStride));
      for (const PlacedBeam& one : ofCell) {
        if (one.isCarried != areCarried) continue;
        const LandedBeam& beam = mesh.beams[faced[one.beam].beam];
        vec2 at[3];
        for (int k = 0; k < 3; ++k) at[k] = (acrossFace(beam.corner[k], place.face) - corner) * scale + 1.0f;
        deposit.add(at[0], at[1], at[2], beam.density, beam.flux * (scale * scale));
      }
      deposit.addTo({planeOf(cell, 0).data(), planeOf(cell, 1).data(), planeOf(cell, 2).data()});
    });
  };
  addBeams(true);
  carryDown(tree);
  addBeams(false);
  const float peak = oneapi::tbb::parallel_reduce(
      IndexRange(0, texels.size(), 4096), 0.0f,
      [&](const IndexRange& range, float most) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) most = std::max(most, texels[i]);
        return most;
      },
      [](float a, float b) { return std::max(a, b); });
  constexpr float kLargestTexel = 3e4f;  // that a half float holds well
  grid.luxOfUnit = peak > 0 ? peak / kLargestTexel : 1;
}

// To each cell with light, and to those within.
void LandedLight::giveTiles(const CellTree& tree, std::span<const PlacedBeam> placed) {
  for (const PlacedBeam& one : placed) cells[one.cell].tile = 0;
  const std::size_t roots = std::size_t(kFaces) * grid.cells.x * grid.cells.y * grid.cells.z;
  uint32_t tiles = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const bool isAbout = cell >= roots && cells[tree.places[cell].parent].tile != kNoTile;
    if (cells[cell].tile != kNoTile || isAbout) cells[cell].tile = tiles++;
  }
  texels.assign(tiles * 3 * kTexelsOfTile, 0);
}

// Adds what coarser cells hold to the finer ones within.
void LandedLight::carryDown(const CellTree& tree) {
  std::vector<std::vector<uint32_t>> ofLevel;
  for (uint32_t cell = 0; cell < cells.size(); ++cell) {
    const CellPlace& place = tree.places[cell];
    if (place.level == 0 || cells[place.parent].tile == kNoTile) continue;
    ofLevel.resize(std::max(ofLevel.size(), std::size_t(place.level) + 1));
    ofLevel[place.level].push_back(cell);
  }
  for (const std::vector<uint32_t>& level : ofLevel)
    oneapi::tbb::parallel_for(std::size_t{0}, level.size(), [&](std::size_t i) {
      const CellPlace& place = tree.places[level[i]];
      const CellPlace& parent = tree.places[place.parent];
      const vec2 offset = acrossFace(place.low - parent.low, place.face) / parent.size * float(kTileTexels);
      for (std::size_t color = 0; color < 3; ++color)
        addCoarser(planeOf(place.parent, color), offset, planeOf(level[i], color));
    });
}

vec3 LandedLight::illuminanceAt(vec3 point, vec3 normal) const {
  if (cells.empty()) return vec3(0);
  const uint face = faceOf(normal);
  const vec3 place = (point - grid.origin) / grid.cellSize;
  if (glm::any(glm::lessThan(place, vec3(0))) || glm::any(glm::greaterThanEqual(place, vec3(grid.cells))))
    return vec3(0);
  uint32_t cell = rootOf(grid, face, uvec3(place));
  vec3 within = place - floor(place);
  while (true) {
    const uint32_t octant =
        uint32_t(within.x >= 0.5f) | uint32_t(within.y >= 0.5f) << 1 | uint32_t(within.z >= 0.5f) << 2;
    const uint32_t child = cells[cell].children[octant];
    if (child == 0) break;
    cell = child;
    within = 2.0f * within - floor(2.0f * within);
  }
  if (cells[cell].tile == kNoTile) return vec3(0);
  const vec2 at = acrossFace(within, face) * float(kTileTexels) + 0.5f;  // texel centres at integers
  const vec2 base = floor(at), part = at - base;
  const float* tile = texels.data() + std::size_t(cells[cell].tile) * 3 * kTexelsOfTile;
  const auto texel = [&](uint32_t x, uint32_t y) {
    const float* red = tile + std::size_t(y) * kTileStride + x;
    return vec3(red[0], red[kTexelsOfTile], red[2 * kTexelsOfTile]);
  };
  const uint32_t x = uint32_t(base.x), y = uint32_t(base.y);
  const vec3 value = mix(mix(texel(x, y), texel(x + 1, y), part.x),
                         mix(texel(x, y + 1), texel(x + 1, y + 1), part.x), part.y);
  return value * std::abs(normal[int(face / 2)]);
}

}  // namespace nephroid
