#include "irradiance_volume/grid.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid {
namespace {

constexpr uint32_t kBins = 512;
constexpr double kTail = 0.001 / 6;  // of the light, beyond each side
constexpr uint32_t kLayersPerTask = 4;

struct Span {
  float first = 0;
  float last = 0;
};

// Where between the extremes light lies along an axis, short of the tails.
Span litSpan(std::span<const PhotonPath> paths, int axis) {
  constexpr int kSteps = 16;
  Span all{std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
  for (const PhotonPath& path : paths)
    for (const float end : {path.origin[axis], path.origin[axis] + path.length * path.direction[axis]}) {
      all.first = std::min(all.first, end);
      all.last = std::max(all.last, end);
    }
  std::array<double, kBins> bins{};
  const float width = std::max((all.last - all.first) / float(kBins), 1e-6f);
  double sum = 0;
  for (const PhotonPath& path : paths)
    for (int step = 0; step < kSteps; ++step) {
      const float at = path.origin[axis] + (float(step) + 0.5f) / kSteps * path.length * path.direction[axis];
      const double light = double(brightness(path)) * double(path.length);
      bins[std::min(std::size_t(std::max((at - all.first) / width, 0.0f)), bins.size() - 1)] += light;
      sum += light;
    }
  uint32_t first = 0, last = kBins;
  for (double below = bins[0]; below <= kTail * sum && first + 1 < kBins; below += bins[first]) ++first;
  for (double above = bins[kBins - 1]; above <= kTail * sum && last > first + 1; above += bins[last - 1])
    --last;
  return {all.first + float(first) * width, all.first + float(last) * width};
}

// The part of a path, from `first` to `last`, that lies in layers `low` to `high` of the grid.
bool clip(vec3 origin, vec3 direction, vec3 low, vec3 high, float& first, float& last) {
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (origin[axis] < low[axis] || origin[axis] >= high[axis]) return false;
      continue;
    }
    const float a = (low[axis] - origin[axis]) / direction[axis];
    const float b = (high[axis] - origin[axis]) / direction[axis];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first < last;
}

// Walks from cell to cell (Amanatides and Woo 1987). Lengths are in cells.
template <class Visit>
void walk(vec3 origin, vec3 direction, float first, float last, ivec3 low, ivec3 high, const Visit& visit) {
  ivec3 cell = clamp(ivec3(floor(origin + first * direction)), low, high - 1);
  vec3 next, step;
  for (int axis = 0; axis < 3; ++axis) {
    step[axis] =
        direction[axis] != 0 ? std::abs(1 / direction[axis]) : std::numeric_limits<float>::infinity();
    const float border = float(cell[axis] + (direction[axis] > 0 ? 1 : 0));
    next[axis] = direction[axis] != 0 ? (border - origin[axis]) / direction[axis]
                                      : std::numeric_limits<float>::infinity();
  }
  for (float at = first; at < last;) {
    const int axis = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
    const float end = std::min(next[axis], last);
    if (end > at) visit(cell, end - at);
    at = std::max(end, at);
    if (end >= last) return;
    cell[axis] += direction[axis] > 0 ? 1 : -1;
    if (cell[axis] < low[axis] || cell[axis] >= high[axis]) return;
    next[axis] += step[axis];
  }
}

// Of layers `low` to `high` of the grid, in the order of the paths.
void fillLayers(std::span<const PhotonPath> paths, const SampleLayout& layout, uint32_t low, uint32_t high,
                std::span<CellSum> cells) {
  const ivec3 first(0, 0, int(low));
  const ivec3 last(int(layout.size.x), int(layout.size.y), int(high));
  for (const PhotonPath& path : paths) {
    const vec3 origin = (path.origin - layout.corner) * layout.placesPerUnit;
    float begin = 0, end = path.length * layout.placesPerUnit;
    if (!clip(origin, path.direction, vec3(first), vec3(last), begin, end)) continue;
    const vec3 vector = brightness(path) * path.direction;
    walk(origin, path.direction, begin, end, first, last, [&](ivec3 at, float length) {
      CellSum& cell = cells[(std::size_t(at.z) - low) * layout.size.x * layout.size.y +
                            std::size_t(at.y) * layout.size.x + std::size_t(at.x)];
      cell.vector += length * vector;
      cell.color += length * path.flux;
    });
  }
}

}  // namespace

LitBox litBox(std::span<const PhotonPath> paths) {
  LitBox box;
  if (paths.empty()) return box;
  for (int axis = 0; axis < 3; ++axis) {
    const Span span = litSpan(paths, axis);
    box.low[axis] = span.first;
    box.high[axis] = span.last;
  }
  return box;
}

SampleLayout gridAround(const LitBox& box, std::size_t cells) {
  const vec3 extent = max(box.high - box.low, vec3(1e-3f));
  float cell = std::cbrt(extent.x * extent.y * extent.z / float(cells));
  uvec3 size;
  for (;; cell *= 1.005f) {
    size = uvec3(ceil(extent / cell));
    if (std::size_t{size.x} * size.y * size.z <= cells) break;
  }
  const vec3 slack = vec3(size) * cell - extent;
  return {box.low - 0.5f * slack, 1 / cell, size, size.x * size.y * size.z * kWordsOfCell};
}

std::vector<CellSum> gridSums(std::span<const PhotonPath> paths, const SampleLayout& layout) {
  const std::size_t layerCells = std::size_t{layout.size.x} * layout.size.y;
  std::vector<CellSum> cells(layerCells * layout.size.z);
  // Lengths are counted in cells, and a cell's volume is its side's cube.
  const float perVolume = layout.placesPerUnit * layout.placesPerUnit;
  const uint32_t tasks = (layout.size.z + kLayersPerTask - 1) / kLayersPerTask;
  oneapi::tbb::parallel_for(uint32_t{0}, tasks, [&](uint32_t task) {
    const uint32_t low = task * kLayersPerTask;
    const uint32_t high = std::min(low + kLayersPerTask, layout.size.z);
    const std::span<CellSum> layers = std::span(cells).subspan(low * layerCells, (high - low) * layerCells);
    fillLayers(paths, layout, low, high, layers);
    for (CellSum& cell : layers) cell.vector *= perVolume;
  });
  return cells;
}

VolumeSample gridSample(std::span<const PhotonPath> paths, std::size_t bytes) {
  VolumeSample sample;
  const std::size_t cells = std::max<std::size_t>(bytes / (kWordsOfCell * sizeof(uint32_t)), 8);
  sample.layout = gridAround(litBox(paths), cells);
  sample.words.resize(sample.layout.words);
  const std::vector<CellSum> sums = gridSums(paths, sample.layout);
  for (std::size_t i = 0; i < sums.size(); ++i) packCell(sums[i], &sample.words[i * kWordsOfCell]);
  return sample;
}

}  // namespace nephroid
