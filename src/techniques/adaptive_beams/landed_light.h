// Light where it landed, at the resolution that it has: a beam is left in cells whose texels are a part of
// its width, so that it touches a few of them whatever its size, and a receiver's point reads one tile, which
// holds what the coarser ones about it have as well.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "beams/ray_mesh/ray_mesh.h"
#include "techniques/adaptive_beams/landed_light_data.h"

namespace nephroid {

struct LandedCell {
  std::array<uint32_t, 8> children{};  // by the halves along x (1), y (2) and z (4); 0: none
  uint32_t tile = kNoTile;
};
static_assert(sizeof(LandedCell) == kCellWords * sizeof(uint32_t));

inline constexpr std::size_t kTexelsOfTile = std::size_t(kTileStride) * kTileStride;

class CellTree;
struct PlacedBeam;

class LandedLight {
 public:
  // Adds nothing to what it had before. The same bytes for any number of threads.
  void build(const RayMesh& mesh);

  // lux at a point of a receiver of unit normal `normal`, on the side that is asked for.
  vec3 illuminanceAt(vec3 point, vec3 normal) const;

  LandedGrid grid{};
  std::vector<LandedCell> cells;  // roots first: rootOf
  // Of each tile: lux across the face of kTexelsOfTile texels, rows first, in red, then in green, then in
  // blue; with what the coarser cells hold.
  std::vector<float> texels;
  std::size_t tileCount() const { return texels.size() / (3 * kTexelsOfTile); }
  std::size_t bytes() const { return cells.size() * sizeof(LandedCell) + texels.size() * sizeof(float); }

 private:
  std::span<float> planeOf(std::size_t cell, std::size_t color) {
    return std::span(texels).subspan((3 * cells[cell].tile + color) * kTexelsOfTile, kTexelsOfTile);
  }
  void giveTiles(const CellTree& tree, std::span<const PlacedBeam> placed);
  void carryDown(const CellTree& tree);
};

}  // namespace nephroid
