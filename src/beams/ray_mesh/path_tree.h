// Paths of light from corners of a mesh of rays, boundary by boundary. At each boundary a path may go two
// ways; each is traced once, when it is first asked for.
#pragma once

#include <oneapi/tbb/concurrent_vector.h>

#include <array>
#include <span>
#include <vector>

#include "beams/footprint.h"
#include "beams/ray_mesh/media_table.h"
#include "beams/ray_mesh/path_spread.h"
#include "trace/paths.h"
#include "trace/ray_scene.h"

namespace nephroid {

// Boundaries that a path may meet before it is given up as trapped, and those that a sheet of light may meet
// before it is followed on by one path alone.
inline constexpr uint8_t kMostBoundaries = 240, kMostOfSheet = 48;

inline constexpr uint8_t kTransmitted = 0, kReflected = 1;

enum class PathState : uint8_t {
  ahead,     // its direction is known, but not yet what it meets
  atCaster,  // it goes on
  arrived,   // where light is wanted
  missed,    // it went elsewhere
  dark,      // something stands between the light and the caster
  lost,      // no light takes this way
};

// One boundary of a path, and the straight way that led there.
struct PathNode {
  vec3 direction{0};        // unit, of the way that led here
  float length = 0;         // m of it, to the first surface; kUnboundedReach where there is none
  vec3 position{0};         // m, on the caster's curved surface, or where it arrived
  uint32_t object = kNone;  // that it met
  vec3 flatPosition{0};     // m, on the caster's triangle
  uint32_t patch = 0;       // smooth surface of it
  vec3 normal{0};           // unit, smooth
  uint32_t corner = kNone;  // of the mesh of rays, where the path begins
  vec3 geometricNormal{0};
  uint32_t parent = kNone;             // none at the first
  vec3 transmittance{1};               // from before the first boundary to this one
  uint32_t child[2] = {kNone, kNone};  // by way; none where not asked for
  uint16_t medium = 0;                 // along the way, of the media table
  uint16_t before = 0;                 // at the boundary, on the side that light comes from
  uint16_t beyond = 0;
  uint8_t generation = 0;  // boundaries before this one
  uint8_t way = 0;         // that it took at the one before
  uint8_t channel = 0;     // of the index of refraction
  uint32_t signature = 0;  // equal for paths that met the same smooth surfaces one after the other
  PathState state = PathState::ahead;
  bool isQueued = false;  // to be traced
  bool isTotal = false;   // all of it was reflected there
  bool isFlat = false;    // it was bent by the triangle's own normal
};

// Where light is wanted: on opaque surfaces, or on a plane that blocks nothing.
struct PathTarget {
  bool isPlane = false;
  PlaneGrid plane{};
};

class PathTree {
 public:
  // All must outlive this.
  PathTree(const Scene& scene, const RayScene& rays, Paths paths, const PathTarget& target,
           MediaTable& media);

  // The ways that light goes on from a node at a caster: bit kTransmitted, bit kReflected.
  uint32_t waysFrom(const PathNode& node) const;

  // The node after `node` that way. A new one is at `fresh`'s end, to be bent and traced.
  uint32_t childOf(uint32_t node, uint8_t way, std::vector<uint32_t>& fresh);

  // A path's first node, at a caster, and what lies there besides.
  uint32_t addFirst(const PathNode& node, std::span<const Touching> touching);

  // Adds a node to `queue` that is to be traced and is in no queue.
  void queue(uint32_t index, std::vector<uint32_t>& queue) {
    PathNode& node = nodes[index];
    if (node.state != PathState::ahead || node.isQueued) return;
    node.isQueued = true;
    queue.push_back(index);
  }

  // Directions and transmittances of new nodes, and then what they meet. In parallel.
  void bend(std::span<const uint32_t> fresh);
  void trace(std::span<const uint32_t> bent);

  std::vector<PathNode> nodes;
  bool hasSpreads = false;          // some lamp has a size
  std::vector<PathSpread> spreads;  // of the nodes, then
  uint64_t raysTraced = 0;

 private:
  void bendOne(PathNode& node) const;
  // Where a path met surfaces that lie in the same place.
  struct Joint {
    uint32_t node = 0;
    std::array<Touching, kMostTouching> touching{};
    uint32_t count = 0;
  };

  void finish(PathNode& node, const Ray& ray, const Hit& hit) const;
  void setSidesOf(std::span<const uint32_t> traced);
  void setSides(PathNode& node, std::span<const Touching> touching);
  PathSpread bentSpread(const PathNode& node) const;
  void carryTo(const PathNode& node, const Hit& hit, PathSpread& spread) const;

  vec3 leftAfter(uint16_t medium, vec3 start, vec3 direction, float length) const;

  const Scene& scene_;
  const RayScene& rays_;
  const Paths paths_;
  const PathTarget& target_;
  std::vector<const Material*> materials_;
  std::vector<uint8_t> hasFewFaces_;  // of the objects, whose light is parted at their edges
  MediaTable& mediaTable_;
  oneapi::tbb::concurrent_vector<Joint> joints_;  // of those that are being traced
};

}  // namespace nephroid
