// Follows view rays through casters as trees: at each boundary what is refracted and what is reflected,
// outside, inside and totally, as far as it can be seen.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "trace/media.h"

namespace nephroid {

// Weight of a way whose end may as well be that of another pixel nearby.
inline constexpr float kFaintWeight = 3e-3f;

// The receiver at the end of one of a view ray's ways, or the sky there. World space.
struct SightEnd {
  vec3 position{0};      // m; of the sky the unit vector toward it
  vec3 normal{0, 1, 0};  // unit, on the side that is seen
  vec3 weight{0};        // the part of its radiance that comes to the eye
  vec2 texcoord{0};
  uint32_t object = kNone;  // kNone: the sky
  uint32_t ways = 0;        // equal where the same smooth surfaces lie on the way, and at its end
  bool isSky() const { return object == kNone; }
  bool isFaint() const { return std::max({weight.x, weight.y, weight.z}) < kFaintWeight; }
};

// All that one view ray shows.
struct SightTree {
  // Its ends, those that are not faint in front, in an order that ways alone decide.
  uint32_t first = 0, count = 0;
  uint32_t strong = 0;  // number of those that are not faint
  vec3 background{0};   // weight of the ways that meet nothing
  uint32_t ways = 0;    // equal for trees that have the same ways, but for faint ones
};

// The straight way of a view ray after its first boundary: what is transmitted there, or, where nothing is,
// what is reflected.
struct WayBeyond {
  vec3 start{0};      // m
  vec3 direction{0};  // unit
  float length = 0;   // m; infinite where nothing is met
};

// How trees are followed.
struct TreeSettings {
  float leastWeight = 7e-4f;  // of a way, of what its tree shows in all; weaker ones are left out
  bool tellsWaysBeyond = false;
  bool tellsSky = false;  // ways that meet nothing have ends too
};

struct SightTrees {
  std::vector<SightTree> trees;
  std::vector<SightEnd> ends;
  std::vector<WayBeyond> waysBeyond;  // of the trees, where they are asked for
  double leftOut = 0;  // sum of the weights of ways that were too weak; the others stand for them
  double lost = 0;     // the same of those that met too many boundaries, or leaked out of a closed mesh
  uint64_t rays = 0;   // traced beyond the first hits
};

inline float largestChannel(vec3 v) {
  return std::max({v.x, v.y, v.z});
}

// `materials`: of the objects. All must outlive it.
class ViewTracer {
 public:
  ViewTracer(const Scene& scene, const RayScene& rays, std::span<const Material* const> materials,
             const TreeSettings& settings);

  // A tree for each ray; they begin inside `media`, and should be near each other. `hits`: what each meets
  // first. Replaces what is in `result`. Several threads may trace at the same time.
  void trace(std::span<const Ray> rays, std::span<const Hit> hits, const MediumStack& media,
             SightTrees& result) const;

 private:
  struct Branch;
  struct Work;
  void traceWaves(std::span<const Hit> hits, Work& work) const;
  void meetNext(Work& work, bool areAlike) const;
  void chooseWeak(Work& work) const;
  static void sortEnds(const Work& work);
  void leaveOut(const Branch& branch, Work& work) const;
  static void makeUp(const Work& work);
  bool isKept(const Branch& branch, const Work& work) const;
  void meet(const Branch& branch, const Hit& hit, Work& work) const;
  static void addEnd(const Branch& branch, const SightEnd& end, Work& work);
  void meetReceiver(const Branch& branch, const Hit& hit, Work& work) const;
  void meetMirror(const Branch& branch, const Hit& hit, Work& work) const;
  void meetThinWall(const Branch& branch, const Hit& hit, Work& work) const;
  void meetDielectric(const Branch& branch, const Hit& hit, Work& work) const;
  void refract(const Branch& branch, const Hit& hit, const MediaSides& sides, uint32_t channels,
               vec3& reflected, Work& work) const;
  bool isFirst(const Branch& branch) const;
  void goOn(Branch branch, const Hit& hit, vec3 direction, std::vector<Branch>& next, Work& work) const;

  const Scene& scene_;
  const RayScene& rays_;
  const std::span<const Material* const> materials_;
  const TreeSettings settings_;
  std::vector<vec3> extinctions_;  // 1/m, of the objects
};

}  // namespace nephroid
