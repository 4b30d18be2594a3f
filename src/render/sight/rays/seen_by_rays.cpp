#include "render/sight/rays/seen_by_rays.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/index_range.h"
#include "scene/volume.h"
#include "trace/surface_color.h"

namespace nephroid {
namespace {

constexpr uint32_t kCell = 4;       // pixels along a side: where its corners agree, trees are interpolated
constexpr uint32_t kTile = 16;      // pixels along a side: what one task looks at
constexpr std::size_t kChunk = 64;  // trees that one task traces
constexpr float kInversePi = 0.318309886f;

// What interpolation may be off in a cell's middle: parts of a pixel where the ray ends, at full weight and
// at least weight; of a weight, and absolutely; of a unit normal.
constexpr float kMostShift = 0.2f, kMostFaintShift = 2;
constexpr float kMostWeightError = 0.004f, kMostFaintError = 5e-4f;
constexpr float kMostTurn = 0.01f;
constexpr float kRoundedTexcoord = 1e-5f;

// What a pixel's ray meets first, where that is a caster.
struct First {
  uint32_t object = kNone;
  uint32_t patch = 0;
  float depth = 0;  // as in the depth image
};

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

vec4 partsAt(vec2 place) {
  return {(1 - place.x) * (1 - place.y), place.x * (1 - place.y), (1 - place.x) * place.y, place.x * place.y};
}

class PixelTrees {
 public:
  PixelTrees(const RaySightInput& input, SeenByRays& seen)
      : in_(input),
        out_(seen),
        tracer_(input.scene, input.rays, input.materials, input.trees),
        pictureRays_(raysOf(input.view)) {}

  void run() {
    placeRegion();
    findFirst();
    if (in_.interpolates) {
      traceCells([&](uvec2 cell, std::vector<uint32_t>& list) { listCorners(cell, list); });
      traceCells([&](uvec2 cell, std::vector<uint32_t>& list) { listMiddle(cell, list); });
      keepAgreeing();
    }
    traceCells([&](uvec2 cell, std::vector<uint32_t>& list) { listOthers(cell, list); });
    write();
    count();
  }

 private:
  // The region is made of whole cells but at the picture's edges; rays may be asked for beyond these.
  void placeRegion() {
    gpu::Region region;
    for (const gpu::Region& one : in_.casterRegions) region = unionOf(region, one);
    out_.region = region;
    cells_ = (region.size + kCell - 1u) / kCell;
    tiles_ = (region.size + kTile - 1u) / kTile;
    width_ = kCell * cells_.x + 1;
    const std::size_t rays = std::size_t(width_) * (kCell * cells_.y + 1);
    first_.assign(rays, {});
    if (out_.firstHits.size() < rays) out_.firstHits.resize(rays);
    treeOf_.assign(rays, kNone);
    isBetween_.assign(std::size_t(cells_.x) * cells_.y, 0);
    const std::size_t pixels = std::size_t(region.size.x) * region.size.y;
    out_.casterNormals.assign(pixels, vec4(0));
    out_.rest.assign(pixels, vec4(0));
    out_.ranges.assign(pixels, uvec2(0));
    if (in_.trees.tellsWaysBeyond)
      for (std::vector<vec4>* list : {&out_.casterPositions, &out_.exits, &out_.directions})
        list->assign(pixels, vec4(0));
    isInTile_.assign(std::size_t(tiles_.x) * tiles_.y, 0);
    raysOfTile_.assign(isInTile_.size(), 0);
    for (const gpu::Region& one : in_.casterRegions) {
      if (one.size.x == 0) continue;
      const uvec2 low = uvec2(one.corner - region.corner) / kTile;
      const uvec2 high = (uvec2(one.corner - region.corner) + one.size - 1u) / kTile;
      for (uint32_t y = low.y; y <= high.y; ++y)
        for (uint32_t x = low.x; x <= high.x; ++x) isInTile_[y * tiles_.x + x] = 1;
    }
  }

  uint32_t indexOf(uvec2 place) const { return place.y * width_ + place.x; }
  uvec2 placeOf(uint32_t index) const { return {index % width_, index / width_}; }

  // Through the middle of a pixel, counted from the region's corner.
  Ray rayThrough(uvec2 place) const {
    const vec2 at = 2.0f * (vec2(out_.region.corner) + vec2(place) + 0.5f) / vec2(in_.size) - 1.0f;
    return {in_.view.eye,
            normalize(pictureRays_.middle + at.x * pictureRays_.right + at.y * pictureRays_.down)};
  }

  void findFirst() {
    oneapi::tbb::parallel_for(std::size_t{0}, isInTile_.size(), [&](std::size_t tile) {
      if (!isInTile_[tile]) return;
      const uvec2 low = kTile * uvec2(tile % tiles_.x, tile / tiles_.x);
      // The last ones have the corners beyond.
      const uvec2 high = glm::min(low + kTile, kCell * cells_ + 1u);
      const uvec2 last = glm::min(high + uvec2(glm::equal(high, kCell * cells_)), kCell * cells_ + 1u);
      thread_local std::vector<Ray> rays;
      thread_local std::vector<Hit> hits;
      rays.clear();
      for (uint32_t y = low.y; y < last.y; ++y)
        for (uint32_t x = low.x; x < last.x; ++x) rays.push_back(rayThrough({x, y}));
      hits.resize(rays.size());
      in_.rays.intersect(rays, hits, true);
      raysOfTile_[tile] = rays.size();
      std::size_t i = 0;
      for (uint32_t y = low.y; y < last.y; ++y)
        for (uint32_t x = low.x; x < last.x; ++x, ++i) keepFirst({x, y}, rays[i], hits[i]);
    });
  }

  void keepFirst(uvec2 place, const Ray& ray, const Hit& hit) {
    if (hit.object == kNone || !in_.materials[hit.object]->isCaster()) return;
    const float depth = in_.view.nearest / (hit.distance * dot(ray.direction, in_.view.forward));
    first_[indexOf(place)] = {hit.object, hit.patch, depth};
    out_.firstHits[indexOf(place)] = hit;
    if (!isPixel(place)) return;
    const bool isOutside = dot(ray.direction, hit.geometricNormal) < 0;
    const std::size_t pixel = pixelOf(place);
    out_.casterNormals[pixel] = isOutside ? vec4(hit.normal, 1) : vec4(-hit.normal, -1);
    out_.rest[pixel].a = depth;
    if (in_.trees.tellsWaysBeyond)
      out_.casterPositions[pixel] = vec4(ray.origin + hit.distance * ray.direction, float(hit.object + 1));
  }

  bool isPixel(uvec2 place) const { return place.x < out_.region.size.x && place.y < out_.region.size.y; }
  std::size_t pixelOf(uvec2 place) const { return std::size_t(place.y) * out_.region.size.x + place.x; }
  bool isCasterAt(uvec2 place) const { return first_[indexOf(place)].object != kNone; }

  // Traces what `list` adds to a list for each cell, in the order of tiles, so that rays are near each other.
  template <class List>
  void traceCells(const List& list) {
    std::vector<uint32_t> all;
    constexpr uint32_t kCells = kTile / kCell;
    for (std::size_t tile = 0; tile < isInTile_.size(); ++tile) {
      if (!isInTile_[tile]) continue;
      const uvec2 low = kCells * uvec2(tile % tiles_.x, tile / tiles_.x);
      const uvec2 high = glm::min(low + kCells, cells_);
      for (uint32_t y = low.y; y < high.y; ++y)
        for (uint32_t x = low.x; x < high.x; ++x) list({x, y}, all);
    }
    const std::size_t firstChunk = chunks_.size();
    chunks_.resize(firstChunk + (all.size() + kChunk - 1) / kChunk);
    for (std::size_t i = 0; i < all.size(); ++i) treeOf_[all[i]] = uint32_t(firstChunk * kChunk + i);
    oneapi::tbb::parallel_for(firstChunk, chunks_.size(), [&](std::size_t chunk) {
      const std::size_t low = (chunk - firstChunk) * kChunk;
      const std::size_t high = std::min(low + kChunk, all.size());
      thread_local std::vector<Ray> rays;
      thread_local std::vector<Hit> hits;
      rays.clear();
      hits.clear();
      for (std::size_t i = low; i < high; ++i) {
        rays.push_back(rayThrough(placeOf(all[i])));
        hits.push_back(out_.firstHits[all[i]]);
      }
      tracer_.trace(rays, hits, in_.media, chunks_[chunk]);
    });
  }

  static std::array<uvec2, 4> cornersOf(uvec2 cell) {
    const uvec2 low = kCell * cell;
    return {low, low + uvec2(kCell, 0), low + uvec2(0, kCell), low + kCell};
  }
  static uvec2 middleOf(uvec2 cell) { return kCell * cell + kCell / 2; }

  void add(uvec2 place, std::vector<uint32_t>& list) {
    const uint32_t index = indexOf(place);
    if (treeOf_[index] != kNone) return;
    treeOf_[index] = 0;  // it is in the list
    list.push_back(index);
  }

  void listCorners(uvec2 cell, std::vector<uint32_t>& list) {
    if (!isOfOneSurface(cell)) return;
    for (const uvec2 corner : cornersOf(cell)) add(corner, list);
  }

  void listMiddle(uvec2 cell, std::vector<uint32_t>& list) {
    const std::array<uvec2, 4> corners = cornersOf(cell);
    const SightTree* first = treeAt(corners[0]);
    for (const uvec2 corner : corners) {
      const SightTree* tree = treeAt(corner);
      if (!tree || tree->ways != first->ways || tree->strong != first->strong) return;
    }
    if (isOfOneSurface(cell)) add(middleOf(cell), list);
  }

  void listOthers(uvec2 cell, std::vector<uint32_t>& list) {
    if (isBetween_[cell.y * cells_.x + cell.x]) return;
    const uvec2 low = kCell * cell, high = glm::min(low + kCell, out_.region.size);
    for (uint32_t y = low.y; y < high.y; ++y)
      for (uint32_t x = low.x; x < high.x; ++x)
        if (isCasterAt({x, y})) add({x, y}, list);
  }

  // Whether all pixels of a cell see one smooth surface, and none of it hides another part.
  bool isOfOneSurface(uvec2 cell) const {
    const uvec2 low = kCell * cell;
    const First& first = first_[indexOf(low)];
    if (first.object == kNone) return false;
    vec4 depths;
    int corner = 0;
    for (const uvec2 place : cornersOf(cell)) depths[corner++] = first_[indexOf(place)].depth;
    const float spread = std::max({depths.x, depths.y, depths.z, depths.w}) -
                         std::min({depths.x, depths.y, depths.z, depths.w});
    const float most = 2 * spread + 1e-3f * first.depth;
    for (uint32_t y = 0; y <= kCell; ++y)
      for (uint32_t x = 0; x <= kCell; ++x) {
        const First& one = first_[indexOf(low + uvec2(x, y))];
        if (one.object != first.object || one.patch != first.patch) return false;
        if (std::abs(one.depth - dot(depths, partsAt(vec2(x, y) / float(kCell)))) > most) return false;
      }
    return true;
  }

  const SightTree* treeAt(uvec2 place) const {
    const uint32_t tree = treeOf_[indexOf(place)];
    return tree == kNone ? nullptr : &chunks_[tree / kChunk].trees[tree % kChunk];
  }
  const SightEnd* endsAt(uvec2 place) const {
    const SightTrees& chunk = chunks_[treeOf_[indexOf(place)] / kChunk];
    return chunk.ends.data() + treeAt(place)->first;
  }

  const WayBeyond& wayBeyondAt(uvec2 place) const {
    const uint32_t tree = treeOf_[indexOf(place)];
    return chunks_[tree / kChunk].waysBeyond[tree % kChunk];
  }

  Blend blendIn(uvec2 cell, vec2 place) const {
    Blend blend;
    std::size_t i = 0;
    for (const uvec2 corner : cornersOf(cell)) {
      blend.trees[i] = treeAt(corner);
      blend.ends[i++] = endsAt(corner);
    }
    blend.parts = partsAt(place);
    return blend;
  }

  void keepAgreeing() {
    oneapi::tbb::parallel_for(0u, cells_.y, [&](uint32_t y) {
      for (uint32_t x = 0; x < cells_.x; ++x) isBetween_[y * cells_.x + x] = agrees({x, y}) ? 1 : 0;
    });
  }

  // Whether a cell's middle shows what its corners tell.
  bool agrees(uvec2 cell) const {
    const SightTree* middle = treeAt(middleOf(cell));
    if (!middle) return false;
    for (const uvec2 corner : cornersOf(cell))
      if (!treeAt(corner) || treeAt(corner)->ways != middle->ways || treeAt(corner)->strong != middle->strong)
        return false;
    const Blend blend = blendIn(cell, vec2(0.5f));
    const SightEnd* ends = endsAt(middleOf(cell));
    if (largestChannel(glm::abs(blend.background() - middle->background)) >
        kMostWeightError * largestChannel(middle->background) + kFaintWeight)
      return false;
    for (uint32_t i = 0; i < middle->strong; ++i)
      if (!isNear(blend, i, ends[i])) return false;
    return true;
  }

  static bool isNear(const Blend& blend, uint32_t i, const SightEnd& end) {
    const float weight = largestChannel(end.weight);
    if (largestChannel(glm::abs(blend.end(i, &SightEnd::weight) - end.weight)) >
        kMostWeightError * weight + kMostFaintError)
      return false;
    const auto apart = [&](std::size_t a, std::size_t b) {
      return distance(blend.ends[a][i].position, blend.ends[b][i].position);
    };
    const float pixel = std::max({apart(0, 1), apart(2, 3), apart(0, 2), apart(1, 3)}) / float(kCell);  // m
    // Where a texture's coordinates begin anew, they jump.
    const auto texelsApart = [&](std::size_t a, std::size_t b) {
      return distance(blend.ends[a][i].texcoord, blend.ends[b][i].texcoord);
    };
    const float texels =
        std::max({texelsApart(0, 1), texelsApart(2, 3), texelsApart(0, 2), texelsApart(1, 3)}) / float(kCell);
    const float most =
        kMostShift * glm::clamp(0.1f / std::max(weight, 1e-6f), 1.0f, kMostFaintShift / kMostShift);
    if (distance(blend.end(i, &SightEnd::position), end.position) > most * pixel) return false;
    if (distance(blend.end(i, &SightEnd::texcoord), end.texcoord) > most * texels + kRoundedTexcoord)
      return false;
    return distance(normalize(blend.end(i, &SightEnd::normal)), end.normal) < kMostTurn;
  }

  // Whether the pixel is interpolated, and in which cell.
  bool isBetween(uvec2 place) const {
    const uvec2 cell = place / kCell;
    return isBetween_[cell.y * cells_.x + cell.x] != 0;
  }

  void write() {
    const uvec2 size = out_.region.size;
    uint32_t points = 0;
    for (uint32_t y = 0; y < size.y; ++y)
      for (uint32_t x = 0; x < size.x; ++x) {
        if (!isCasterAt({x, y})) continue;
        const uint32_t count = pointsOf({x, y});
        out_.ranges[pixelOf({x, y})] = {points, count};
        points += count;
      }
    out_.positions.resize(points);
    out_.normals.resize(points);
    out_.factors.resize(points);
    oneapi::tbb::parallel_for(0u, size.y, [&](uint32_t y) {
      for (uint32_t x = 0; x < size.x; ++x)
        if (isCasterAt({x, y})) writePixel({x, y});
    });
  }

  // Of an interpolated pixel, the corner of its cell whose faint ways it has.
  static uvec2 nearestCorner(uvec2 place) { return (place + kCell / 2 - 1u) / kCell * kCell; }

  uint32_t pointsOf(uvec2 place) const {
    return treeAt(isBetween(place) ? nearestCorner(place) : place)->count;
  }

  void writePixel(uvec2 place) {
    const std::size_t pixel = pixelOf(place);
    const uvec2 range = out_.ranges[pixel];
    vec3 rest(0);
    if (isBetween(place)) {
      const Blend blend = blendIn(place / kCell, vec2(place % kCell) / float(kCell));
      rest = blend.background() * in_.scene.environment.background;
      const SightTree& nearest = *treeAt(nearestCorner(place));
      const SightEnd* faint = endsAt(nearestCorner(place));
      for (uint32_t i = nearest.strong; i < nearest.count; ++i) rest += writePoint(range.x + i, faint[i]);
      for (uint32_t i = 0; i < nearest.strong; ++i) {
        SightEnd end = blend.ends[0][i];
        end.position = blend.end(i, &SightEnd::position);
        end.normal = normalize(blend.end(i, &SightEnd::normal));
        end.weight = blend.end(i, &SightEnd::weight);
        end.texcoord = blend.end(i, &SightEnd::texcoord);
        rest += writePoint(range.x + i, end);
      }
    } else {
      const SightEnd* ends = endsAt(place);
      rest = treeAt(place)->background * in_.scene.environment.background;
      for (uint32_t i = 0; i < range.y; ++i) rest += writePoint(range.x + i, ends[i]);
    }
    out_.rest[pixel] = vec4(rest, out_.rest[pixel].a);
    if (in_.trees.tellsWaysBeyond) writeWayBeyond(place);
  }

  void writeWayBeyond(uvec2 place) {
    WayBeyond way;
    const auto add = [&](uvec2 tree, float part) {
      const WayBeyond& one = wayBeyondAt(tree);
      way.start += part * one.start;
      way.direction += part * one.direction;
      way.length += part * one.length;
    };
    if (isBetween(place)) {
      const vec4 parts = partsAt(vec2(place % kCell) / float(kCell));
      int corner = 0;
      for (const uvec2 at : cornersOf(place / kCell)) add(at, parts[corner++]);
    } else {
      add(place, 1);
    }
    const std::size_t pixel = pixelOf(place);
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

  void count() {
    RaySightCounts& counts = out_.counts;
    counts = {};
    for (const std::size_t rays : raysOfTile_) counts.rays += rays;
    for (const SightTrees& chunk : chunks_) {
      counts.rays += chunk.rays;
      counts.traced += chunk.trees.size();
      counts.leftOut += chunk.leftOut;
      counts.lost += chunk.lost;
    }
    counts.points = out_.positions.size();
    for (const vec4& rest : out_.rest) counts.pixels += rest.a > 0;
    if (counts.traced == 0) return;
    counts.leftOut /= double(counts.traced);
    counts.lost /= double(counts.traced);
  }

  const RaySightInput& in_;
  SeenByRays& out_;
  const ViewTracer tracer_;
  const PictureRays pictureRays_;
  uvec2 cells_{0}, tiles_{0};
  uint32_t width_ = 0;             // rays in a row
  std::vector<First> first_;       // of the rays
  std::vector<uint32_t> treeOf_;   // of the rays: in chunks_; kNone where it was not traced
  std::vector<uint8_t> isInTile_;  // of the tiles: whether casters may be there
  std::vector<std::size_t> raysOfTile_;
  std::vector<uint8_t> isBetween_;  // of the cells: whether they are interpolated
  std::vector<SightTrees> chunks_;  // of kChunk trees each but the last of a list
};

}  // namespace

void seeByRays(const RaySightInput& input, SeenByRays& seen) {
  PixelTrees(input, seen).run();
}

}  // namespace nephroid
