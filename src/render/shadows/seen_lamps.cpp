#include "render/shadows/seen_lamps.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/color.h"
#include "geometry/bounds.h"
#include "render/shadows/lamp_places.h"

namespace nephroid {
namespace {

constexpr uint32_t kRemembered = 3;     // points of a pixel that are remembered each; the others together
constexpr uint32_t kAskedSamples = 2;   // so many have to have seen the same,
constexpr uint32_t kReach = 2;          // in a square of pixels that goes so far to each side
constexpr std::size_t kMostBoxes = 64;  // that are told apart
constexpr uint32_t kFirstPlaces = 4;    // on a lamp with a size
constexpr uint32_t kPlacesOfAll = 512, kFewestPlaces = 16, kMostPlaces = 64;  // at the edge of a shadow

// What is seen of a lamp, from one place or several.
constexpr uint8_t kAll = 1, kNothing = 2, kEdge = kAll | kNothing;

uint32_t placesOf(const SampleOfMany& sample) {
  return sample.count == 1 ? kFewestPlaces
                           : std::clamp(kPlacesOfAll / sample.count, kFewestPlaces, kMostPlaces);
}

// Whether a box that is wider by `margin` (m) reaches into a way.
bool isOnWay(const Box& box, float margin, vec3 from, vec3 direction, float length) {
  const vec2 part = wayThroughBox(box.low - margin, box.high + margin, from, direction, length);
  return part.x <= part.y;
}

// Whether something may stand between a lamp and points in a box.
bool mayBeShadowed(const ShadowedLamp& lamp, const Box& points) {
  const Light& light = *lamp.light;
  const vec3 from = points.center();
  const float wide = 0.501f * points.diagonal();
  if (light.type == LightType::directional) {
    const float spread = std::tan(glm::radians(0.5f * light.angle));
    return std::ranges::any_of(lamp.boxes, [&](const Box& box) {
      const float farthest = distance(box.center(), from) + box.diagonal() + wide;
      return isOnWay(box, wide + spread * farthest, from, -light.direction, farthest);
    });
  }
  const vec3 offset = middleOf(light) - from;
  const float away = length(offset), margin = std::max(wide, 1.001f * extentOf(light));
  return !(away > 0) || std::ranges::any_of(lamp.boxes, [&](const Box& box) {
    return isOnWay(box, margin, from, offset / away, away);
  });
}

// A point whose light is asked for, and its rays.
struct Asking {
  uint32_t point = 0;
  uvec2 pixel{0};
  std::size_t memory = 0;
  uint32_t firstRay = 0, rays = 0;
  float whole = 0, seen = 0;  // light that comes if nothing stands before the lamp, and that comes

  uint8_t state() const {
    if (whole == 0) return 0;
    return seen == whole ? kAll : seen == 0 ? kNothing : kEdge;
  }
  uint8_t part() const { return whole > 0 ? uint8_t(255 * seen / whole + 0.5f) : uint8_t(255); }
};

// The points of a tile that ask.
struct Questions {
  std::vector<Asking> asking;
  std::vector<std::pair<uint32_t, uint32_t>> equals;  // points, and which of `asking` is in the same place
  std::vector<Ray> rays;
  std::vector<float> lights;  // of the rays
  std::vector<uint8_t> isHidden;

  void clear() {
    asking.clear();
    equals.clear();
    rays.clear();
    lights.clear();
  }

  void add(const ViewPoints& points, uint32_t point, uvec2 pixel, std::size_t memory) {
    if (!asking.empty() && points.positions[asking.back().point] == points.positions[point])
      equals.emplace_back(point, uint32_t(asking.size() - 1));
    else
      asking.push_back({.point = point, .pixel = pixel, .memory = memory});
  }

  void ask(const RayScene& scene, const ShadowedLamp& lamp, Asking& one, vec3 point, vec3 normal,
           vec2 place) {
    const Illumination from = lampLight(*lamp.light, lamp.shaped, point, place);
    const float cosine = -dot(from.direction, normal);
    const float light = cosine * luminanceOf(from.illuminance);
    if (!(light > 0)) return;
    rays.push_back(scene.fromMeter(point, -from.direction, cosine, from.distance));
    lights.push_back(light);
    one.whole += light;
    ++one.rays;
  }

  void answer(const RayScene& scene) {
    isHidden.resize(rays.size());
    scene.occluded(rays, isHidden);
    for (Asking& one : asking)
      for (uint32_t ray = one.firstRay; ray < one.firstRay + one.rays; ++ray)
        if (!isHidden[ray]) one.seen += lights[ray];
  }
};

}  // namespace

struct SeenLamps::Look {
  const RayScene& rays;
  const ShadowedLamp& lamp;
  uint32_t index;  // of the lamp
  const ViewPoints& points;
  SampleOfMany sample;
  bool asksMemory;

  // Calls `work` with each point number `layer` of a pixel in a tile, the pixel, and its place in the tile.
  template <class Work>
  void forPoints(uvec2 tile, uint32_t layer, const Work& work) const {
    const uvec2 low = kPixelsAlongTile * tile, high = glm::min(low + kPixelsAlongTile, points.size);
    for (uint32_t y = low.y; y < high.y; ++y)
      for (uint32_t x = low.x; x < high.x; ++x) {
        uint32_t point = y * points.size.x + x;
        if (!points.ranges.empty()) {
          if (layer >= points.ranges[point].y) continue;
          point = points.ranges[point].x + layer;
        }
        work(point, points.corner + uvec2(x, y), uvec2(x, y) - low);
      }
  }

  // The most points of a pixel in a tile.
  uint32_t mostIn(uvec2 tile) const {
    if (points.ranges.empty()) return 1;
    const uvec2 low = kPixelsAlongTile * tile, high = glm::min(low + kPixelsAlongTile, points.size);
    uint32_t most = 0;
    for (uint32_t y = low.y; y < high.y; ++y)
      for (uint32_t x = low.x; x < high.x; ++x) most = std::max(most, points.ranges[y * points.size.x + x].y);
    return most;
  }

  // `work` for the first points of the pixels of each tile, their second ones, and so on.
  template <class Work>
  void forTiles(const Work& work) const {
    const uvec2 tiles = (points.size + kPixelsAlongTile - 1u) / kPixelsAlongTile;
    oneapi::tbb::parallel_for(0u, tiles.x * tiles.y, [&](uint32_t i) {
      const uvec2 tile(i % tiles.x, i / tiles.x);
      const uint32_t most = mostIn(tile);
      for (uint32_t layer = 0; layer < most; ++layer) work(tile, layer);
    });
  }

  void ask(Questions& questions, uint32_t places) const {
    for (Asking& one : questions.asking) {
      one.firstRay = uint32_t(questions.rays.size());
      const vec3 point(points.positions[one.point]), normal(points.normals[one.point]);
      const uvec2 turn = turnAt(one.pixel, index);
      const uint32_t first = sample.index * placesOf(sample);
      for (uint32_t i = 0; i < places; ++i)
        questions.ask(rays, lamp, one, point, normal, evenPlace(first + i, turn));
    }
    questions.answer(rays);
  }
};

std::size_t SeenLamps::memoryAt(uvec2 pixel, uint32_t layer) const {
  return (std::size_t(std::min(layer, kRemembered)) * picture_.y + pixel.y) * picture_.x + pixel.x;
}

void SeenLamps::resize(uvec2 picture) {
  picture_ = picture;
  forget();
}

void SeenLamps::forget() {
  samples_ = 0;
}

void SeenLamps::look(const RayScene& rays, std::span<const ShadowedLamp> lamps, const ViewPoints& points,
                     const SampleOfMany& sample) {
  const std::size_t memories = points.ranges.empty() ? 1 : kRemembered + 1;
  parts_.resize(lamps.size());
  seen_.resize(lamps.size());
  for (uint32_t i = 0; i < lamps.size(); ++i) {
    if (lamps[i].boxes.empty()) continue;
    parts_[i].assign(points.positions.size(), 255);
    Memory& memory = seen_[i];
    if (samples_ == 0) memory.before.clear();
    memory.before.resize(memories * picture_.x * picture_.y, 0);
    memory.now = memory.before;
    lookAt({rays, lamps[i], i, points, sample, samples_ >= kAskedSamples});
  }
  ++samples_;
}

void SeenLamps::lookAt(const Look& look) {
  look.forTiles([&](uvec2 tile, uint32_t layer) { lookFirst(look, tile, layer); });
  seen_[look.index].before.swap(seen_[look.index].now);
  if (hasSize(*look.lamp.light))
    look.forTiles([&](uvec2 tile, uint32_t layer) { lookCloser(look, tile, layer); });
}

// What was seen around each pixel of a tile.
SeenLamps::TileStates SeenLamps::seenAround(const Look& look, uvec2 tile, uint32_t layer) const {
  constexpr uint32_t kWidth = kPixelsAlongTile + 2 * kReach;
  const uvec2 low = kPixelsAlongTile * tile, high = glm::min(low + kPixelsAlongTile, look.points.size);
  const uvec2 first = low - glm::min(low, uvec2(kReach)), last = glm::min(high + kReach, look.points.size);
  std::array<std::array<uint8_t, kPixelsAlongTile>, kWidth> alongRows{};
  for (uint32_t y = first.y; y < last.y; ++y) {
    std::array<uint8_t, kWidth> row{};
    const uint8_t* from = &seen_[look.index].before[memoryAt(look.points.corner + uvec2(first.x, y), layer)];
    std::copy_n(from, last.x - first.x, row.begin() + (first.x + kReach - low.x));
    for (uint32_t away = 0; away <= 2 * kReach; ++away)
      for (uint32_t x = 0; x < kPixelsAlongTile; ++x) alongRows[y + kReach - low.y][x] |= row[x + away];
  }
  TileStates around{};
  for (uint32_t y = 0; y < kPixelsAlongTile; ++y)
    for (uint32_t away = 0; away <= 2 * kReach; ++away)
      for (uint32_t x = 0; x < kPixelsAlongTile; ++x) around[y][x] |= alongRows[y + away][x];
  return around;
}

// Whether all of a tile saw the same.
bool SeenLamps::isSure(const TileStates& around) {
  const uint8_t first = around[0][0];
  return (first == kAll || first == kNothing) && std::ranges::all_of(around, [&](const auto& row) {
           return std::ranges::all_of(row, [&](uint8_t state) { return state == first; });
         });
}

// The pixels of a tile, each of which has its own point, saw this and see it still.
void SeenLamps::keep(const Look& look, uvec2 tile, uint8_t state) {
  const uvec2 low = kPixelsAlongTile * tile, high = glm::min(low + kPixelsAlongTile, look.points.size);
  for (uint32_t y = low.y; y < high.y; ++y) {
    std::fill_n(&parts_[look.index][std::size_t(y) * look.points.size.x + low.x], high.x - low.x,
                state == kAll ? uint8_t(255) : uint8_t(0));
  }
}

void SeenLamps::lookFirst(const Look& look, uvec2 tile, uint32_t layer) {
  thread_local Questions questions;
  questions.clear();
  std::vector<uint8_t>& parts = parts_[look.index];
  Memory& memory = seen_[look.index];
  const TileStates around = look.asksMemory ? seenAround(look, tile, layer) : TileStates{};
  if (look.points.ranges.empty() && isSure(around)) return keep(look, tile, around[0][0]);
  Box box;
  look.forPoints(tile, layer, [&](uint32_t point, uvec2 pixel, uvec2 inTile) {
    const std::size_t place = memoryAt(pixel, layer);
    const uint8_t known = around[inTile.y][inTile.x];
    if (known == kAll || known == kNothing) {
      parts[point] = known == kAll ? 255 : 0;
    } else if (look.points.positions[point].a > 0) {
      questions.add(look.points, point, pixel, place);
      box.include(vec3(look.points.positions[point]));
    }
  });
  if (questions.asking.empty()) return;
  if (!mayBeShadowed(look.lamp, box)) {
    for (const Asking& one : questions.asking) memory.now[one.memory] |= kAll;
    return;
  }
  look.ask(questions, hasSize(*look.lamp.light) ? kFirstPlaces : 1);
  for (const Asking& one : questions.asking) {
    memory.now[one.memory] |= one.state();
    parts[one.point] = one.part();
  }
  for (const auto& [point, other] : questions.equals) parts[point] = parts[questions.asking[other].point];
}

void SeenLamps::lookCloser(const Look& look, uvec2 tile, uint32_t layer) {
  thread_local Questions questions;
  questions.clear();
  const TileStates around = seenAround(look, tile, layer);
  look.forPoints(tile, layer, [&](uint32_t point, uvec2 pixel, uvec2 inTile) {
    if (around[inTile.y][inTile.x] == kEdge && look.points.positions[point].a > 0)
      questions.add(look.points, point, pixel, memoryAt(pixel, layer));
  });
  if (questions.asking.empty()) return;
  look.ask(questions, placesOf(look.sample));
  std::vector<uint8_t>& parts = parts_[look.index];
  for (const Asking& one : questions.asking) parts[one.point] = one.part();
  for (const auto& [point, other] : questions.equals) parts[point] = parts[questions.asking[other].point];
}

std::vector<ShadowedLamp> shadowedLamps(const Scene& scene, const std::vector<MeshExtent>& extents) {
  std::vector<ShadowedLamp> lamps;
  for (const Light& light : scene.lights) {
    if (light.type == LightType::sky) continue;
    ShadowedLamp lamp{&light, shapedLight(scene, light), boxesThatShadow(scene, extents, light)};
    if (lamp.boxes.size() > kMostBoxes) {
      Box all;
      for (const Box& box : lamp.boxes) all.include(box);
      lamp.boxes = {all};
    }
    lamps.push_back(std::move(lamp));
  }
  return lamps;
}

}  // namespace nephroid
