// Sheets of light: triangles between three paths of a mesh of rays, followed from boundary to boundary, and
// parted where their paths part.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "beams/ray_mesh/caster_light.h"
#include "beams/ray_mesh/caster_scales.h"
#include "beams/ray_mesh/edge_table.h"
#include "beams/ray_mesh/facet_rims.h"
#include "beams/ray_mesh/ray_mesh.h"

namespace nephroid {

inline constexpr float kUnknownBend = 1e30f;

// Light onto a part of a caster's triangle, along one way at each boundary.
struct Sheet {
  uint32_t node[3];       // of its corners' paths, at the boundary where it is followed to
  uint32_t triangle = 0;  // of the caster's mesh
  vec2 weights[3];        // of its corners, in that triangle
  vec3 flux{0};           // lm onto it
  float gain = 1;         // in it, for light that it stands for besides its own
  // m that its sides' middles are expected to land off the middles of their ends; of one path alone, the
  // radius of the beam that it stands for.
  float bend = kUnknownBend;
  uint64_t path = 0;   // bit i: reflected at boundary i
  uint64_t aside = 0;  // bit i: not the first of the ways at boundary i
  uint32_t light = 0;
  uint8_t generation = 0;  // boundaries that it has passed
  uint8_t cuts = 0;
  bool isSettled = false;  // it stays as it is: more paths would tell less of its light
};

// Cuts of a sheet of one path alone, which is not cut.
inline constexpr uint8_t kWhole = 255;

// 0 to 1, at random, the same for the same numbers.
inline float chance(uint32_t a, uint32_t b) {
  uint64_t x = (uint64_t(a) << 32 | b) + 0x9e3779b97f4a7c15u;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return float((x ^ x >> 31) >> 40) * 0x1p-24f;
}

// A corner that is not yet traced.
struct NewCorner {
  uint32_t light = 0;
  uint32_t triangle = 0;
  vec2 weights{0};
};

// A path that is asked for.
struct PathAsk {
  uint32_t corner = 0;
  uint64_t path = 0;
  uint8_t generation = 0;
  uint32_t node = kNone;  // what is found: where the path stands, or where it ended before
};

// Lists that each picture needs anew. Kept, so that their memory need not be asked for again. Of one trace
// at a time.
struct SheetMemory {
  CutSkies skies;
  std::vector<NewCorner> pending;
  std::vector<uint32_t> firstOfCorner;
  std::vector<EdgeTable> middles;
  std::vector<PathAsk> cutAsks;
  std::vector<uint32_t> fresh, asked, ahead;
  std::vector<Sheet> sheets, next, mixed, landed, worst;

  // Gives back lists that are larger than those of a picture that is made again and again.
  void giveBackLarge();
};

// Light that is followed together: all of `lights`, where there is memory for the paths, else as few groups
// as there have to be.
std::vector<std::span<const CasterLight>> lightGroups(const Scene& scene, std::span<const CasterLight> lights,
                                                      uint64_t mostBytes);

class LightSheets {
 public:
  // All must outlive this. `media`: those that `lights` were made with.
  LightSheets(const Scene& scene, const RayScene& rays, const RayMeshSettings& settings,
              std::span<const CasterLight> lights, MediaTable& media, SheetMemory& memory);

  // The sheets at the casters' own triangles, which are appended.
  void addFirstSheets(std::vector<Sheet>& sheets);

  // Follows sheets whose paths are traced up to where they stand, until they land. None are left; what lands
  // is appended to `landed`, in an order that does not depend on the number of threads.
  void follow(std::vector<Sheet>& sheets, std::vector<Sheet>& landed, Progress& progress);

  // Cuts each of the sheets in four; the parts stand where the sheets stood, with their paths traced.
  void cut(std::span<const Sheet> sheets, std::vector<Sheet>& parts);

  // Whether the three paths of a sheet have gone so far apart that what lies between them is not between its
  // corners.
  bool isChaotic(const Sheet& sheet) const;

  // Divides sheets that landed where finer ones beside them have corners. The whole light stays the same.
  void conform(std::vector<Sheet>& landed) const;

  vec3 carried(const Sheet& sheet) const {
    return sheet.flux *
           (tree.nodes[sheet.node[0]].transmittance + tree.nodes[sheet.node[1]].transmittance +
            tree.nodes[sheet.node[2]].transmittance) /
           3.0f;
  }
  std::size_t bytes() const;
  uint32_t casterOf(const Sheet& sheet) const { return lights_[sheet.light].object; }
  const LampSpread& spreadOf(const Sheet& sheet) const { return lights_[sheet.light].spread; }

  PathTree tree;
  CasterScales scales;
  RayMeshStats stats;

 private:
  struct SideCut;

  uint32_t addCorner(const NewCorner& corner);
  void settleCorners();
  void reach(std::vector<PathAsk>& asks);
  uint32_t middleOf(const Sheet& sheet, int side) const;
  void addConforming(const Sheet& sheet, std::vector<Sheet>& conforming) const;
  vec3 cornerPosition(const Sheet& sheet, vec2 weights) const;
  vec3 fluxOf(const Sheet& sheet) const;
  vec3 fluxOf(const Sheet& sheet, vec3 a, vec3 b, vec3 c) const;
  std::vector<vec3> fluxesOntoTriangles(const CasterLight& light) const;
  void cutWide(std::vector<Sheet>& sheets);
  void expand(const Sheet& sheet, std::vector<Sheet>& children);
  void traceChildren(std::vector<Sheet>& children);
  void prune(std::vector<Sheet>& sheets);
  void chooseAmongWeak(std::vector<Sheet>& children);
  void part(std::span<const Sheet> mixed, std::vector<Sheet>& next);
  void clip(std::span<const Sheet> mixed, std::vector<Sheet>& ones, std::vector<Sheet>& next);
  void giveToOnes(std::span<const Sheet> sheets, std::vector<Sheet>& next);
  void giveToEach(std::span<const Sheet> sheets, std::vector<Sheet>& next);
  Sheet pathOfCorner(const Sheet& sheet, int corner) const;
  float partOfMemory() const;
  float spreadAt(std::array<uint32_t, 3> nodes) const;
  bool isCutAhead(const Sheet& sheet) const;
  bool carriesNone(uint32_t node) const;
  bool isElsewhere(const Sheet& sheet) const;
  bool isFacetedAt(const PathNode& node) const;
  float fullFlux(const Sheet& sheet) const { return fullFluxes_[sheet.light]; }
  float lightestParted(const Sheet& sheet) const;
  float mostCarried(const Sheet& sheet) const;

  const Scene& scene_;
  const RayScene& rays_;
  const RayMeshSettings& settings_;
  std::span<const CasterLight> lights_;
  std::vector<std::optional<FacetRims>> rims_;  // of the meshes of casters
  std::size_t firstSheets_ = 0;
  std::vector<float> fullFluxes_;  // lm, of the lights, as in CasterScales
  SheetMemory& memory_;
  std::vector<NewCorner>& pending_;
  std::vector<uint32_t>& firstOfCorner_;  // node; kNone until it is settled
  std::vector<EdgeTable>& middles_;       // by light
};

}  // namespace nephroid
