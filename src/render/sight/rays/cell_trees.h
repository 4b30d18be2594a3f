// The trees of the rays through casters: where the corners and the middle of a cell agree, its other pixels
// are interpolated; elsewhere each pixel has a tree.
#pragma once

#include "render/sight/rays/caster_rays.h"
#include "render/sight/rays/view_tree.h"

namespace nephroid {

// The four corners of a cell, and their parts of a place in it.
struct Blend {
  std::array<const SightTree*, 4> trees{};
  std::array<const SightEnd*, 4> ends{};
  vec4 parts{0};

  template <class Value>
  Value end(std::size_t i, Value SightEnd::*member) const {
    return ends[0][i].*member * parts[0] + ends[1][i].*member * parts[1] + ends[2][i].*member * parts[2] +
           ends[3][i].*member * parts[3];
  }
  vec3 background() const {
    return trees[0]->background * parts[0] + trees[1]->background * parts[1] +
           trees[2]->background * parts[2] + trees[3]->background * parts[3];
  }
};

class CellTrees {
 public:
  // Traces them. All must outlive it.
  CellTrees(const RaySightInput& input, const CasterRays& rays);

  // Null where none was traced.
  const SightTree* treeAt(uvec2 place) const;
  // Of a tree that was traced.
  const SightEnd* endsAt(uvec2 place) const;
  const WayBeyond& wayBeyondAt(uvec2 place) const;

  // Whether the pixel is interpolated in its cell.
  bool isBetween(uvec2 place) const;
  Blend blendAt(uvec2 place) const {
    return blendIn(place / CasterRays::kCell, vec2(place % CasterRays::kCell) / float(CasterRays::kCell));
  }

  // Adds to its counts what was traced, left out and lost.
  void count(RaySightCounts& counts) const;

 private:
  using List = void (CellTrees::*)(uvec2 cell, std::vector<uint32_t>& list);
  void traceCells(List list);
  void add(uvec2 place, std::vector<uint32_t>& list);
  void listCorners(uvec2 cell, std::vector<uint32_t>& list);
  void listMiddle(uvec2 cell, std::vector<uint32_t>& list);
  void listOthers(uvec2 cell, std::vector<uint32_t>& list);
  void keepAgreeing();
  Blend blendIn(uvec2 cell, vec2 place) const;
  bool agrees(uvec2 cell) const;
  bool showsFaintSky(uvec2 place) const;
  static bool isNear(const Blend& blend, uint32_t i, const SightEnd& end);

  const RaySightInput& in_;
  const CasterRays& rays_;
  const ViewTracer tracer_;
  const float meanSky_;             // nit
  std::vector<uint32_t> treeOf_;    // of the rays: in chunks_; kNone where it was not traced
  std::vector<uint8_t> isBetween_;  // of the cells: whether they are interpolated
  std::vector<SightTrees> chunks_;  // of kChunk trees each but the last of a list
};

}  // namespace nephroid
