// The light of a scene's lamps through its casters as a mesh of rays: corners are shared, a side's middle is
// traced once, and triangles are cut level by level where what they carry, times how far it lands off what
// their corners say, is worth it (after Watt 1990, Collins 1994 and Nishita and Nakamae 1994, whose beams
// are cut for their size alone).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "beams/ray_mesh/path_tree.h"
#include "core/error.h"
#include "core/progress.h"
#include "scene/scene.h"

namespace nephroid {

struct RayMeshSettings {
  float error = 0.01f;  // that the light may have, root mean square over the mean of what is lit
  Paths paths = Paths::all;
  PathTarget target;
  // m: no receiver's point shows more; and m for each from an eye there, up to a part of the caster's size.
  float detail = 0.01f;
  float mostDetailOfCaster = 1e30f;
  float detailPerMeter = 0;
  vec3 eye{0};
  float detailsOfPoint = 1;  // across a receiver's point, over which light chosen by lot is evened out
  // m2 over which the mean of the light is taken; 0: where nine tenths of it land
  float area = 0;
  // Of a plane target, where light is wanted, in its texels.
  vec2 wantedLow{0}, wantedHigh{0};
  uint64_t mostBeams = 4'000'000;
  uint64_t mostBytes = uint64_t{1} << 30;
};

// The light between three paths that land. World space.
struct LandedBeam {
  vec3 corner[3];                      // m, where they land
  vec3 density{1};                     // at the corners, of light over its mean in the beam
  vec3 flux{0};                        // lm
  float width = 0;                     // m, across its longest side
  float texel = 0;                     // m, of the texels that its light is kept in
  bool isPath = false;                 // one path alone, for light about it
  uint32_t object = 0;                 // that they land on
  vec3 leastNormal{0}, mostNormal{0};  // of the receiver's side that is lit, at the corners, axis by axis
};

// Where a beam's light came along, for pictures of it.
struct BeamPaths {
  uint32_t node[3];  // where the paths of its corners land; of one path alone three times the same
  uint8_t cuts = 0;
};

inline constexpr std::size_t kToldLevels = 24;

// What kept the error that was asked for from being reached.
enum class RayMeshBound : uint8_t { none, beams, bytes };

struct RayMeshStats {
  uint64_t rays = 0;
  uint64_t shadowRays = 0;
  uint64_t bytes = 0;
  double incidentFlux = 0;   // lm, luminance, onto casters
  double landedFlux = 0;     // where it is wanted
  double droppedFlux = 0;    // branches that were not followed
  double lostFlux = 0;       // of triangles whose paths end nowhere
  double shadedFlux = 0;     // stopped before it met a caster
  double missedFlux = 0;     // that went elsewhere than where it is wanted
  uint64_t singlePaths = 0;  // beams that are one path
  double error = 0;          // that was reached
  uint32_t fewSkyParts = 0;  // as in LightOntoCasters
  RayMeshBound bound = RayMeshBound::none;
  std::array<uint64_t, kToldLevels> beamsByLevel{};
  std::array<uint64_t, kToldLevels> beamsByBranch{};  // by the boundaries that they crossed
};

struct SheetMemory;

struct RayMesh {
  // None where there are so many triangles and lamps that the lamps are followed one after the other.
  std::vector<PathNode> nodes;
  std::vector<BeamPaths> paths;  // of the beams
  std::vector<LandedBeam> beams;
  RayMeshStats stats;
  std::shared_ptr<SheetMemory> memory;  // to be used again; copies share it
};

// The paths of the casters' own triangles already take more than settings.mostBytes.
struct TooManyPaths : RuntimeFailure {
  explicit TooManyPaths(uint64_t bytesOfAll)
      : RuntimeFailure("the paths of light take too much memory"), bytes(bytesOfAll) {}
  uint64_t bytes;
};

// Makes `mesh` anew; what it held before is gone, and its memory is used again. The same bytes for any number
// of threads. Throws TooManyPaths, and Interrupted after Ctrl-C.
void traceRayMesh(const Scene& scene, const RayScene& rays, const RayMeshSettings& settings,
                  Progress& progress, RayMesh& mesh);

}  // namespace nephroid
