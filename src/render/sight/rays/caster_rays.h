// The rays through the middles of the pixels that may show casters, and what they meet first. They lie in
// cells, which share the rays of their corners, and the cells in tiles.
#pragma once

#include <array>
#include <vector>

#include "render/sight/rays/seen_by_rays.h"

namespace nephroid {

class CasterRays {
 public:
  static constexpr uint32_t kCell = 4;   // pixels along a side
  static constexpr uint32_t kTile = 16;  // pixels along a side: what one task looks at

  // What a pixel's ray meets first, where that is a caster.
  struct First {
    uint32_t object = kNone;
    uint32_t patch = 0;
    float depth = 0;  // as in the depth image
  };

  // Traces them. Places `seen`'s region and gives it what the pixels show of casters' surfaces.
  CasterRays(const RaySightInput& input, SeenByRays& seen);

  // Of all rays; some are of corners outside the region.
  std::size_t size() const { return first_.size(); }
  uint32_t indexOf(uvec2 place) const { return place.y * width_ + place.x; }
  uvec2 placeOf(uint32_t index) const { return {index % width_, index / width_}; }
  // Through the middle of a pixel, counted from the region's corner.
  Ray rayThrough(uvec2 place) const;
  const Hit& hitOf(uint32_t index) const { return seen_.firstHits[index]; }
  uint64_t traced() const;

  uvec2 cells() const { return cells_; }
  static std::array<uvec2, 4> cornersOf(uvec2 cell) {
    const uvec2 low = kCell * cell;
    return {low, low + uvec2(kCell, 0), low + uvec2(0, kCell), low + kCell};
  }
  static uvec2 middleOf(uvec2 cell) { return kCell * cell + kCell / 2; }
  // The parts that the four corners have of a place in their cell (0 to 1).
  static vec4 partsAt(vec2 place);
  // Those that may show casters, in the order of tiles, so that the next is near.
  std::vector<uvec2> cellsOfTiles() const;
  // Whether all pixels of a cell see one smooth surface, and none of it hides another part.
  bool isOfOneSurface(uvec2 cell) const;

  bool isCasterAt(uvec2 place) const { return first_[indexOf(place)].object != kNone; }
  bool isPixel(uvec2 place) const { return place.x < seen_.region.size.x && place.y < seen_.region.size.y; }
  std::size_t pixelOf(uvec2 place) const { return std::size_t(place.y) * seen_.region.size.x + place.x; }

 private:
  void placeRegion();
  void findFirst();
  void keepFirst(uvec2 place, const Ray& ray, const Hit& hit);

  const RaySightInput& in_;
  SeenByRays& seen_;
  const PictureRays pictureRays_;
  uvec2 cells_{0}, tiles_{0};
  uint32_t width_ = 0;  // rays in a row
  std::vector<First> first_;
  std::vector<uint8_t> isInTile_;  // of the tiles: whether casters may be there
  std::vector<std::size_t> raysOfTile_;
};

}  // namespace nephroid
