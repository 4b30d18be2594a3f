#include "render/sight/rays/seen_by_rays.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>

#include "render/sight/rays/cell_trees.h"
#include "scene/volume.h"
#include "trace/surface_color.h"

namespace nephroid {
namespace {

constexpr uint32_t kCell = CasterRays::kCell;
constexpr float kInversePi = 0.318309886f;

// Writes what the pixels see.
class PixelPoints {
 public:
  PixelPoints(const RaySightInput& input, const CasterRays& rays, const CellTrees& trees, SeenByRays& seen)
      : in_(input), rays_(rays), trees_(trees), out_(seen) {}

  void write() {
    const uvec2 size = out_.region.size;
    uint32_t points = 0;
    for (uint32_t y = 0; y < size.y; ++y)
      for (uint32_t x = 0; x < size.x; ++x) {
        if (!rays_.isCasterAt({x, y})) continue;
        const uint32_t count = pointsOf({x, y});
        out_.ranges[rays_.pixelOf({x, y})] = {points, count};
        points += count;
      }
    out_.positions.resize(points);
    out_.normals.resize(points);
    out_.factors.resize(points);
    oneapi::tbb::parallel_for(0u, size.y, [&](uint32_t y) {
      for (uint32_t x = 0; x < size.x; ++x)
        if (rays_.isCasterAt({x, y})) writePixel({x, y});
    });
  }

 private:
  // Of an interpolated pixel, the corner of its cell whose faint ways it has.
  static uvec2 nearestCorner(uvec2 place) { return (place + kCell / 2 - 1u) / kCell * kCell; }

  uint32_t pointsOf(uvec2 place) const {
    const uvec2 from = trees_.isBetween(place) ? nearestCorner(place) : place;
    const uint32_t count = trees_.treeAt(from)->count;
    if (!in_.trees.tellsSky) return count;
    const SightEnd* ends = trees_.endsAt(from);
    return count -
           uint32_t(std::count_if(ends, ends + count, [](const SightEnd& end) { return end.isSky(); }));
  }

  // How wide a look at the sky is (radians): by how far apart it is from looks of some neighbors, so many
  // pixels away, that go the same way.
  float widthOf(const SightEnd& end, const std::array<uvec2, 4>& neighbors, float away) const {
    float most = 0;
    for (const uvec2 neighbor : neighbors) {
      const SightTree* tree = trees_.treeAt(neighbor);
      if (!tree) continue;
      const SightEnd* ends = trees_.endsAt(neighbor);
      for (uint32_t i = 0; i < tree->count; ++i)
        if (ends[i].ways == end.ways) most = std::max(most, distance(ends[i].position, end.position));
    }
    return in_.sampleSpacing * (most > 0 ? most / away : in_.view.pixelAngle);
  }

  static std::array<uvec2, 4> neighborsOf(uvec2 place) {
    return {uvec2(std::max(place.x, 1u) - 1, place.y), uvec2(place.x + 1, place.y),
            uvec2(place.x, std::max(place.y, 1u) - 1), uvec2(place.x, place.y + 1)};
  }

  void writePixel(uvec2 place) {
    const std::size_t pixel = rays_.pixelOf(place);
    const uvec2 range = out_.ranges[pixel];
    vec3 rest(0);
    uint32_t next = range.x;
    const bool isBlended = trees_.isBetween(place);
    const std::array<uvec2, 4> neighbors =
        isBlended ? CasterRays::cornersOf(place / kCell) : neighborsOf(place);
    const auto show = [&](const SightEnd& end) {
      if (end.isSky())
        rest += end.weight *
                in_.skies->luminance(end.position, widthOf(end, neighbors, isBlended ? float(kCell) : 1.0f));
      else
        rest += writePoint(next++, end);
    };
    if (isBlended) {
      const Blend blend = trees_.blendAt(place);
      rest = blend.background() * in_.scene.environment.background;
      const SightTree& nearest = *trees_.treeAt(nearestCorner(place));
      const SightEnd* faint = trees_.endsAt(nearestCorner(place));
      for (uint32_t i = nearest.strong; i < nearest.count; ++i) show(faint[i]);
      for (uint32_t i = 0; i < nearest.strong; ++i) {
        SightEnd end = blend.ends[0][i];
        end.position = blend.end(i, &SightEnd::position);
        if (end.isSky()) end.position = normalize(end.position);
        end.normal = normalize(blend.end(i, &SightEnd::normal));
        end.weight = blend.end(i, &SightEnd::weight);
        end.texcoord = blend.end(i, &SightEnd::texcoord);
        show(end);
      }
    } else {
      const SightEnd* ends = trees_.endsAt(place);
      rest = trees_.treeAt(place)->background * in_.scene.environment.background;
      for (uint32_t i = 0; i < trees_.treeAt(place)->count; ++i) show(ends[i]);
    }
    out_.rest[pixel] = vec4(rest, out_.rest[pixel].a);
    if (in_.trees.tellsWaysBeyond) writeWayBeyond(place);
  }

  void writeWayBeyond(uvec2 place) {
    WayBeyond way;
    const auto add = [&](uvec2 tree, float part) {
      const WayBeyond& one = trees_.wayBeyondAt(tree);
      way.start += part * one.start;
      way.direction += part * one.direction;
      way.length += part * one.length;
    };
    if (trees_.isBetween(place)) {
      const vec4 parts = CasterRays::partsAt(vec2(place % kCell) / float(kCell));
      int corner = 0;
      for (const uvec2 at : CasterRays::cornersOf(place / kCell)) add(at, parts[corner++]);
    } else {
      add(place, 1);
    }
    const std::size_t pixel = rays_.pixelOf(place);
    out_.exits[pixel] = vec4(way.start, std::min(way.length, std::numeric_limits<float>::max()));
    out_.directions[pixel] = vec4(way.direction, 0);
  }

  // Returns what it adds to the pixel (nit) by no light.
  vec3 writePoint(std::size_t point, const SightEnd& end) {
    const Material& material = *in_.materials[end.object];
    const bool hasTexture = !in_.scene.meshOf(in_.scene.objects[end.object]).texcoords.empty();
    const vec3 factor = end.weight * kInversePi *
                        (hasTexture ? diffuseReflectance(in_.scene, material, end.texcoord) : material.color);
    out_.positions[point] = vec4(end.position, 1);
    out_.normals[point] = vec4(end.normal, 0);
    out_.factors[point] = vec4(factor, 0);
    return factor * in_.scene.environment.ambient + end.weight * material.emission;
  }

  const RaySightInput& in_;
  const CasterRays& rays_;
  const CellTrees& trees_;
  SeenByRays& out_;
};

RaySightCounts countsOf(const CasterRays& rays, const CellTrees& trees, const SeenByRays& seen) {
  RaySightCounts counts;
  counts.rays = rays.traced();
  trees.count(counts);
  counts.points = seen.positions.size();
  for (const vec4& rest : seen.rest) counts.pixels += rest.a > 0;
  return counts;
}

}  // namespace

void seeByRays(const RaySightInput& input, SeenByRays& seen) {
  const CasterRays rays(input, seen);
  const CellTrees trees(input, rays);
  PixelPoints(input, rays, trees, seen).write();
  seen.counts = countsOf(rays, trees, seen);
}

}  // namespace nephroid
