#include "render/sight/rays/caster_rays.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid {

CasterRays::CasterRays(const RaySightInput& input, SeenByRays& seen)
    : in_(input), seen_(seen), pictureRays_(raysOf(input.view)) {
  placeRegion();
  findFirst();
}

// The region is made of whole cells but at the picture's edges; rays may be asked for beyond these.
void CasterRays::placeRegion() {
  gpu::Region region;
  for (const gpu::Region& one : in_.casterRegions) region = unionOf(region, one);
  seen_.region = region;
  cells_ = (region.size + kCell - 1u) / kCell;
  tiles_ = (region.size + kTile - 1u) / kTile;
  width_ = kCell * cells_.x + 1;
  const std::size_t rays = std::size_t(width_) * (kCell * cells_.y + 1);
  first_.assign(rays, {});
  if (seen_.firstHits.size() < rays) seen_.firstHits.resize(rays);
  const std::size_t pixels = std::size_t(region.size.x) * region.size.y;
  seen_.casterNormals.assign(pixels, vec4(0));
  seen_.rest.assign(pixels, vec4(0));
  seen_.ranges.assign(pixels, uvec2(0));
  if (in_.trees.tellsWaysBeyond)
    for (std::vector<vec4>* list : {&seen_.casterPositions, &seen_.exits, &seen_.directions})
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

Ray CasterRays::rayThrough(uvec2 place) const {
  const vec2 at = 2.0f * (vec2(seen_.region.corner) + vec2(place) + 0.5f) / vec2(in_.size) - 1.0f;
  return {in_.view.eye,
          normalize(pictureRays_.middle + at.x * pictureRays_.right + at.y * pictureRays_.down)};
}

void CasterRays::findFirst() {
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

void CasterRays::keepFirst(uvec2 place, const Ray& ray, const Hit& hit) {
  if (hit.object == kNone || !in_.materials[hit.object]->isCaster()) return;
  const float depth = in_.view.nearest / (hit.distance * dot(ray.direction, in_.view.forward));
  first_[indexOf(place)] = {hit.object, hit.patch, depth};
  seen_.firstHits[indexOf(place)] = hit;
  if (!isPixel(place)) return;
  const bool isOutside = dot(ray.direction, hit.geometricNormal) < 0;
  const std::size_t pixel = pixelOf(place);
  seen_.casterNormals[pixel] = isOutside ? vec4(hit.normal, 1) : vec4(-hit.normal, -1);
  seen_.rest[pixel].a = depth;
  if (in_.trees.tellsWaysBeyond)
    seen_.casterPositions[pixel] = vec4(ray.origin + hit.distance * ray.direction, float(hit.object + 1));
}

uint64_t CasterRays::traced() const {
  return std::accumulate(raysOfTile_.begin(), raysOfTile_.end(), uint64_t{0});
}

vec4 CasterRays::partsAt(vec2 place) {
  return {(1 - place.x) * (1 - place.y), place.x * (1 - place.y), (1 - place.x) * place.y, place.x * place.y};
}

std::vector<uvec2> CasterRays::cellsOfTiles() const {
  std::vector<uvec2> list;
  constexpr uint32_t kCells = kTile / kCell;
  for (std::size_t tile = 0; tile < isInTile_.size(); ++tile) {
    if (!isInTile_[tile]) continue;
    const uvec2 low = kCells * uvec2(tile % tiles_.x, tile / tiles_.x);
    const uvec2 high = glm::min(low + kCells, cells_);
    for (uint32_t y = low.y; y < high.y; ++y)
      for (uint32_t x = low.x; x < high.x; ++x) list.emplace_back(x, y);
  }
  return list;
}

bool CasterRays::isOfOneSurface(uvec2 cell) const {
  const uvec2 low = kCell * cell;
  const First& first = first_[indexOf(low)];
  if (first.object == kNone) return false;
  vec4 depths;
  int corner = 0;
  for (const uvec2 place : cornersOf(cell)) depths[corner++] = first_[indexOf(place)].depth;
  const float spread =
      std::max({depths.x, depths.y, depths.z, depths.w}) - std::min({depths.x, depths.y, depths.z, depths.w});
  const float most = 2 * spread + 1e-3f * first.depth;
  for (uint32_t y = 0; y <= kCell; ++y)
    for (uint32_t x = 0; x <= kCell; ++x) {
      const First& one = first_[indexOf(low + uvec2(x, y))];
      if (one.object != first.object || one.patch != first.patch) return false;
      if (std::abs(one.depth - dot(depths, partsAt(vec2(x, y) / float(kCell)))) > most) return false;
    }
  return true;
}

}  // namespace nephroid
