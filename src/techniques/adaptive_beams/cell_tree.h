// The cells of landed light while it is made: an octree for each face, as fine as the beams that land in it.
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "geometry/box.h"
#include "techniques/adaptive_beams/landed_light.h"

namespace nephroid {

// A beam as it lands on receivers of one face.
struct FacedBeam {
  uint32_t beam;
  uint8_t face;
  uint8_t level;  // of cells whose texels are a part of its width
};

// Where a faced beam is added to a cell's tile.
struct PlacedBeam {
  uint32_t cell;
  uint32_t beam;   // index of the faced beam
  bool isCarried;  // the finer cells within take it from this tile
};

inline constexpr uint32_t kMany = kNone - 1;

struct CellPlace {
  vec3 low;    // m
  float size;  // m
  uint8_t face;
  uint8_t level;
  uint32_t parent = 0;
  uint32_t object = kNone;  // that beams land on which ask for this cell; kMany of several
  bool isShared = false;    // beams of another object ask for this cell or for a finer one within
};

// Nothing here depends on the number of threads.
class CellTree {
 public:
  // Adds the coarsest cells to `light`, whose grid is known, and the finer ones that beams ask for. All
  // outlive this.
  CellTree(LandedLight& light, const RayMesh& mesh, const std::vector<FacedBeam>& faced);

  // Where each beam is added. A beam is added to the finest cells there are, so that light is cut in the same
  // texels on both sides of a border between beams; only far wider beams are left coarser, and carried. By
  // cell, and in the order of the beams.
  std::vector<PlacedBeam> place() const;

  std::vector<CellPlace> places;  // of light.cells

 private:
  // What a beam has light in: a box, a plane within it, and its sides as seen across the face.
  struct Bounds {
    uint8_t face = 0;
    Box box;
    vec3 normal{0};  // unit
    vec3 corner{0};
    vec3 spare{0};        // m, that the box is larger on each side
    vec2 outward[3]{};    // of each side
    float farthest[3]{};  // along it
    bool meets(vec3 low, float size) const;
  };
  // A cell that a beam asks for, and the object that the beam lands on.
  struct CellRequest {
    uint8_t level = 0;
    uint8_t face = 0;
    uint64_t place = 0;  // 21 bits each of x, y and z, in cells of its level
    uint32_t object = kNone;
    bool operator==(const CellRequest&) const = default;
    bool operator<(const CellRequest& other) const {
      return std::tie(level, face, place, object) <
             std::tie(other.level, other.face, other.place, other.object);
    }
    uvec3 at() const {
      constexpr uint64_t kMask = (1u << 21) - 1;
      return {uint32_t(place & kMask), uint32_t(place >> 21 & kMask), uint32_t(place >> 42)};
    }
  };

  // Cells that are asked for. Beams next to each other ask for the same: most repetitions are left out.
  class CellRequests {
   public:
    void add(const CellRequest& request) {
      CellRequest& recent = recent_[(request.place * 0x9e3779b97f4a7c15u >> 40 ^ request.level) % kRecent];
      if (recent == request) return;
      recent = request;
      requests.push_back(request);
    }
    std::vector<CellRequest> requests;

   private:
    static constexpr std::size_t kRecent = 256;
    std::array<CellRequest, kRecent> recent_{};
  };

  Bounds boundsOf(const FacedBeam& faced) const;
  float sizeAt(uint32_t level) const { return light_.grid.cellSize / float(1u << level); }
  // Calls visit(x, y, z) for the cells of that level that may be met.
  template <class Visit>
  void forCells(const Bounds& bounds, uint32_t level, const Visit& visit) const;
  uint32_t cellAt(const FacedBeam& faced, uvec3 at) const;
  template <class Ask>
  std::vector<CellRequest> requestedBy(const Ask& ask) const;
  void addCells(const std::vector<CellRequest>& requests);
  void addCell(const CellRequest& request);
  bool markShared();
  void askWithin(uint32_t cell, uvec3 at, const FacedBeam& faced, const Bounds& bounds,
                 CellRequests& asked) const;
  CellPlace childPlace(uint32_t cell, uint32_t octant) const;
  void placeIn(uint32_t cell, uint32_t index, const Bounds& bounds, std::vector<PlacedBeam>& placed) const;

  LandedLight& light_;
  const RayMesh& mesh_;
  const std::vector<FacedBeam>& faced_;
  std::vector<Bounds> bounds_;  // of each of them
};

}  // namespace nephroid
