#include "irradiance_volume/shells.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace nephroid {
namespace {

constexpr float kStepsPerCell = 3;      // fewer, and steps beat with cells
constexpr uint32_t kProbeAcross = 32;   // cells along the side of the shells that placement is judged on,
constexpr std::size_t kProbeEvery = 8;  // by every so many paths
constexpr float kEvenShare = 0.25f;     // of the shells, that lie evenly whatever the light does
constexpr uint32_t kCellsAcrossPerShell = 3;
constexpr uint32_t kPartsOfRegion = 16;  // filled in parallel

// Steradians per square of the octahedral map's unit square: of a plane at distance 1 / sqrt(3) of a cube's
// diagonal, seen from its center.
float solidAnglePerSquare(vec2 square) {
  const vec2 p = abs(2.0f * square - 1.0f);
  const float fold = std::max(p.x + p.y - 1, 0.0f);
  const vec3 onOctahedron(p.x - fold, p.y - fold, std::abs(1 - p.x - p.y));
  const float distance = length(onOctahedron);
  return 4 / (distance * distance * distance);
}

// Half the side of the square about the light's direction, on the octahedral map, that holds all paths' ends
// but 0.1 % of their light.
float lightReach(std::span<const PhotonPath> paths) {
  constexpr std::size_t kShareBins = 256;
  std::array<double, kShareBins> bins{};
  double sum = 0;
  for (const PhotonPath& path : paths)
    for (const float along : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
      const vec3 place = path.origin + along * path.length * path.direction;
      const vec2 aside = abs(octahedralFromDirection(normalize(place)) - 0.5f);
      const auto bin = std::min(std::size_t(2 * std::max(aside.x, aside.y) * kShareBins), kShareBins - 1);
      bins[bin] += double(brightness(path)) * double(path.length);
      sum += double(brightness(path)) * double(path.length);
    }
  std::size_t last = kShareBins;
  for (double beyond = bins[kShareBins - 1]; beyond <= 0.001 * sum && last > 1; beyond += bins[last - 1])
    --last;
  return 0.5f * float(last) / kShareBins;
}

// Shells as cells of a grid: across, across, from within outward.
class ShellGrid {
 public:
  ShellGrid(uvec3 size, float reach) : size_(size), words_(kShellWords) {
    words_[0] = std::bit_cast<uint32_t>(2 * reach);
    for (uint32_t i = 0; i <= kShellRadii; ++i) setShellAt(i, float(size.z) * float(i) / float(kShellRadii));
  }
  // Which shell is at `radius` / kShellRadii of the region's radius.
  void setShellAt(uint32_t radius, float shell) { words_[1 + radius] = std::bit_cast<uint32_t>(shell); }
  float shellAt(uint32_t radius) const { return std::bit_cast<float>(words_[1 + radius]); }

  uvec3 size() const { return size_; }
  const std::vector<uint32_t>& words() const { return words_; }
  vec3 placeOf(vec3 point) const { return placeInShells({size_, words_.data()}, point); }
  float reach() const { return 0.5f * std::bit_cast<float>(words_[0]); }

  // Regions' radii, of the shell's inner border.
  float innerRadius(float shell) const {
    for (uint32_t i = 0; i < kShellRadii; ++i) {
      const float low = shellAt(i), high = shellAt(i + 1);
      if (shell <= high)
        return (float(i) + (high > low ? (shell - low) / (high - low) : 0)) / float(kShellRadii);
    }
    return 1;
  }

 private:
  uvec3 size_;
  std::vector<uint32_t> words_;
};

// Light times length and square of the distance from the center in every cell, in the order of the paths.
// Lengths and places in regions' radii.
std::vector<CellSum> fill(std::span<const PhotonPath> paths, float radius, const ShellGrid& grid) {
  const uvec3 size = grid.size();
  std::vector<CellSum> sums(std::size_t{size.x} * size.y * size.z);
  std::vector<float> thickness(size.z);
  for (uint32_t z = 0; z < size.z; ++z)
    thickness[z] = grid.innerRadius(float(z + 1)) - grid.innerRadius(float(z));
  // Every task goes along all paths and fills shells of its own.
  oneapi::tbb::parallel_for(uint32_t{0}, kPartsOfRegion, [&](uint32_t part) {
    const uint32_t low = part * size.z / kPartsOfRegion, high = (part + 1) * size.z / kPartsOfRegion;
    if (low == high) return;
    const float inner = grid.innerRadius(float(low)), outer = grid.innerRadius(float(high));
    for (const PhotonPath& path : paths) {
      const vec3 origin = path.origin / radius;
      const float along = dot(origin, path.direction);
      const float aside2 =
          dot(origin, origin) - along * along;  // squared distance of the line from the center
      if (aside2 >= outer * outer) continue;
      const float half = std::sqrt(outer * outer - aside2);
      const float hole = aside2 < inner * inner ? std::sqrt(inner * inner - aside2) : 0;
      const auto spread = [&](float first, float last) {
        first = std::max(first, 0.0f);
        last = std::min(last, path.length / radius);
        if (first >= last) return;
        const float middle = std::max(0.5f * (inner + outer), 0.05f);
        float finest = 2 * middle * grid.reach() / float(size.x);
        for (uint32_t z = low; z < high; ++z) finest = std::min(finest, thickness[z]);
        const auto steps =
            std::max(1u, std::min(uint32_t(std::ceil((last - first) * kStepsPerCell / finest)), 4096u));
        const float step = (last - first) / float(steps);
        for (uint32_t i = 0; i < steps; ++i) {
          const vec3 point = origin + (first + (float(i) + 0.5f) * step) * path.direction;
          const vec3 place = grid.placeOf(point);
          const ivec3 cell(floor(place));
          if (cell.x < 0 || cell.y < 0 || cell.x >= int(size.x) || cell.y >= int(size.y) ||
              cell.z < int(low) || cell.z >= int(high))
            continue;
          CellSum& sum =
              sums[(std::size_t(cell.z) * size.y + std::size_t(cell.y)) * size.x + std::size_t(cell.x)];
          const float square = std::max(dot(point, point), kLeastShellSquare);
          sum.vector += (step * square * brightness(path)) * path.direction;
          sum.color += step * path.flux;
        }
      };
      // The line runs inward to the hole, if it meets it, then outward again.
      spread(-along - half, -along - hole);
      spread(-along + hole, -along + half);
    }
  });
  return sums;
}

// Cubic regions' radii of a cell.
float volumeOf(const ShellGrid& grid, uvec3 cell) {
  constexpr int kParts = 4;
  const float side = 2 * grid.reach();
  float solidAngle = 0;
  for (int y = 0; y < kParts; ++y)
    for (int x = 0; x < kParts; ++x) {
      const vec2 place = (vec2(cell) + (vec2(float(x), float(y)) + 0.5f) / float(kParts)) / vec2(grid.size());
      solidAngle += solidAnglePerSquare((place - 0.5f) * side + 0.5f) / float(kParts * kParts);
    }
  solidAngle *= side * side / float(grid.size().x * grid.size().y);
  const float inner = grid.innerRadius(float(cell.z)), outer = grid.innerRadius(float(cell.z + 1));
  return solidAngle * (outer * outer * outer - inner * inner * inner) / 3;
}

// Puts shells where what goes through them, by direction from the center, differs most from one to the next.
void placeShells(std::span<const PhotonPath> paths, float radius, ShellGrid& grid) {
  const ShellGrid probe({kProbeAcross, kProbeAcross, kShellRadii}, grid.reach());
  std::vector<PhotonPath> some;
  for (std::size_t i = 0; i < paths.size(); i += kProbeEvery) some.push_back(paths[i]);
  const std::vector<CellSum> sums = fill(some, radius, probe);
  constexpr std::size_t kLayer = kProbeAcross * kProbeAcross;
  std::array<float, kShellRadii> change{};
  float all = 0;
  for (std::size_t z = 0; z + 1 < kShellRadii; ++z) {
    // A shell's cells grow with the square of its radius, as what they hold was made to.
    const float radiusOfShell = (float(z) + 1) / float(kShellRadii);
    for (std::size_t i = 0; i < kLayer; ++i) {
      const float difference = length(sums[z * kLayer + i].vector - sums[(z + 1) * kLayer + i].vector) /
                               (radiusOfShell * radiusOfShell);
      change[z] += 0.5f * difference;
      change[z + 1] += 0.5f * difference;
      all += difference;
    }
  }
  if (all <= 0) return;
  float shell = 0;
  for (uint32_t i = 0; i < kShellRadii; ++i) {
    const float share = kEvenShare / float(kShellRadii) + (1 - kEvenShare) * change[i] / all;
    shell += share * float(grid.size().z);
    grid.setShellAt(i + 1, std::min(shell, float(grid.size().z)));
  }
  grid.setShellAt(kShellRadii, float(grid.size().z));
}

}  // namespace

VolumeSample shellSample(std::span<const PhotonPath> paths, float radius, std::size_t bytes) {
  VolumeSample sample;
  if (paths.empty()) return sample;
  const double cells =
      double(bytes / sizeof(uint32_t) - std::min<std::size_t>(kShellWords, bytes / 8)) / kWordsOfCell;
  const auto across = std::max(2u, uint32_t(std::cbrt(cells * kCellsAcrossPerShell)));
  const auto shells = std::max(2u, uint32_t(cells / double(across * across)));
  ShellGrid grid({across, across, shells}, lightReach(paths));
  placeShells(paths, radius, grid);
  const std::vector<CellSum> sums = fill(paths, radius, grid);
  sample.words = grid.words();
  sample.words.resize(kShellWords + kWordsOfCell * sums.size());
  sample.layout = {vec3(0), 1 / radius, grid.size(), uint32_t(sample.words.size())};
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const auto z = uint32_t(i / (across * across)), y = uint32_t(i / across % across),
               x = uint32_t(i % across);
    // Lengths and volumes were counted in regions' radii, the flux in square bounding radii.
    const float scale = 1 / (volumeOf(grid, {x, y, z}) * radius * radius);
    packCell({scale * sums[i].vector, scale * sums[i].color}, &sample.words[kShellWords + kWordsOfCell * i]);
  }
  return sample;
}

}  // namespace nephroid
