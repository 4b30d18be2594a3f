#include "transport/table/fill.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <new>
#include <string>

#include "core/error.h"
#include "geometry/bounds.h"
#include "geometry/curved_triangle.h"

namespace nephroid {
namespace {

using RowRange = oneapi::tbb::blocked_range<uint32_t>;
constexpr uint32_t kVerticesPerTask = 32;

uint32_t toUnorm16(float x) {
  // Written so that a NaN becomes 0.
  const float inUnit = x > 0 ? (x < 1 ? x : 1) : 0;
  return static_cast<uint32_t>(inUnit * 65535.0f + 0.5f);
}

float fractionOf(float part, float whole) {
  return whole > 0 ? part / whole : 0;
}

uint32_t pathCode(const OutgoingRay& ray) {
  const uint32_t signature = ray.flags & kRayLost ? kCodeLost : 1 + ray.signature % kCodeSignatures;
  return signature | (ray.flags & kRayOccluded ? kCodeOccluded : 0);
}

// A table under construction. Path lengths wait in meters until the longest is known.
struct Filling {
  TableLayout layout;
  uint32_t directions;
  std::unique_ptr<uint32_t[]> words;
  std::unique_ptr<float[]> pathLengths;

  uint32_t* block(uint32_t row) const { return words.get() + std::size_t{row} * layout.blockWords; }
  float* paths(uint32_t row) const { return pathLengths.get() + std::size_t{row} * directions; }
};

// m: how far a curved surface rises above its triangles, judged at their middles and those of their sides.
float largestRise(const Mesh& mesh) {
  float largest = 0;
  if (!mesh.isCurved) return largest;
  for (const uvec3& t : mesh.triangles) {
    const mat3 corners(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]);
    const mat3 normals(mesh.normals[t.x], mesh.normals[t.y], mesh.normals[t.z]);
    for (const vec3& weights :
         {vec3(1 / 3.0f), vec3(0.5f, 0.5f, 0), vec3(0, 0.5f, 0.5f), vec3(0.5f, 0, 0.5f)})
      largest = std::max(largest, length(curvedOffset(corners * weights, weights, corners, normals)));
  }
  return largest;
}

TableLayout layoutAround(const TableKey& key, const Mesh& mesh) {
  TableLayout layout = layoutOf(key);
  const Box box = boundingBox(mesh);
  const float rise = largestRise(mesh);
  layout.boxMinimum = box.low - rise;
  layout.boxExtent = box.high + rise - layout.boxMinimum;
  return layout;
}

void packCore(const TableLayout& layout, const OutgoingRay& ray, float transmittance, uint32_t* core) {
  const vec3 fromCorner = ray.position - layout.boxMinimum;
  const vec2 square = octahedralFromDirection(ray.direction);
  core[0] = toUnorm16(fractionOf(fromCorner.x, layout.boxExtent.x)) |
            toUnorm16(fractionOf(fromCorner.y, layout.boxExtent.y)) << 16;
  core[1] = toUnorm16(fractionOf(fromCorner.z, layout.boxExtent.z)) | toUnorm16(square.x) << 16;
  core[2] = toUnorm16(square.y) | toUnorm16(transmittance) << 16;
}

// All of a block but its path lengths. Returns the longest of these.
float packBlock(const Filling& filling, uint32_t row, std::span<const vec3> localDirections,
                std::span<const OutgoingRay> rays) {
  const float ior = filling.layout.ior[static_cast<int>(row / filling.layout.vertices)];
  uint32_t* block = filling.block(row);
  std::fill_n(block, filling.layout.blockWords, 0);
  uint32_t* codes = block + 3 * filling.directions + (filling.directions + 1) / 2;
  float longest = 0;
  for (uint32_t i = 0; i < filling.directions; ++i) {
    const float entering = 1 - fresnelReflectance(-localDirections[i].z, 1 / ior);
    packCore(filling.layout, rays[i], fractionOf(rays[i].transmittance.x, entering), block + 3 * i);
    codes[i / 4] |= pathCode(rays[i]) << (8 * (i % 4));
    filling.paths(row)[i] = rays[i].pathLength;
    longest = std::max(longest, rays[i].pathLength);
  }
  return longest;
}

void packPathLengths(const Filling& filling, uint32_t row) {
  uint32_t* packed = filling.block(row) + 3 * filling.directions;
  for (uint32_t i = 0; i < filling.directions; ++i) {
    packed[i / 2] |= toUnorm16(fractionOf(filling.paths(row)[i], filling.layout.pathScale)) << (16 * (i % 2));
  }
}

// Returns the longest path inside, in meters.
float traceAll(const Filling& filling, const Mesh& mesh, const VertexTracer& trace, Progress& progress) {
  const TableLayout& layout = filling.layout;
  std::vector<vec3> local(filling.directions);
  for (uint32_t i = 0; i < filling.directions; ++i)
    local[i] = sampledDirection(i, layout.rings, layout.azimuths);
  return oneapi::tbb::parallel_reduce(
      RowRange(0, layout.vertices * layout.bands, kVerticesPerTask), 0.0f,
      [&](const RowRange& range, float longest) {
        std::vector<vec3> directions(filling.directions);
        std::vector<OutgoingRay> rays(filling.directions);
        for (uint32_t row = range.begin(); row < range.end(); ++row) {
          const uint32_t vertex = row % layout.vertices;
          const mat3 frame = vertexFrame(mesh.normals[vertex]);
          std::transform(local.begin(), local.end(), directions.begin(),
                         [&](const vec3& d) { return frame * d; });
          trace(vertex, layout.ior[static_cast<int>(row / layout.vertices)], directions, rays);
          longest = std::max(longest, packBlock(filling, row, local, rays));
        }
        progress.advance(range.size());
        return longest;
      },
      [](float a, float b) { return std::max(a, b); });
}

}  // namespace

TransportTable fillTable(const TableKey& key, const Mesh& mesh, const VertexTracer& trace,
                         Progress& progress) try {
  Filling filling{layoutAround(key, mesh), key.directions(), nullptr, nullptr};
  const uint32_t rows = filling.layout.vertices * filling.layout.bands;
  filling.words = std::make_unique_for_overwrite<uint32_t[]>(key.words());
  filling.pathLengths = std::make_unique_for_overwrite<float[]>(std::size_t{rows} * filling.directions);
  progress.begin("light transport table", rows);
  filling.layout.pathScale = traceAll(filling, mesh, trace, progress);
  oneapi::tbb::parallel_for(RowRange(0, rows), [&](const RowRange& range) {
    for (uint32_t row = range.begin(); row < range.end(); ++row) packPathLengths(filling, row);
  });
  progress.finish();
  TableView view;
  static_cast<TableLayout&>(view) = filling.layout;
  view.words = filling.words.get();
  return {key, view, std::shared_ptr<const uint32_t[]>(std::move(filling.words))};
} catch (const std::bad_alloc&) {
  throw RuntimeFailure("out of memory: the light transport table of mesh '" + mesh.name + "' takes " +
                       std::to_string(key.words() * 4 / 1000000) +
                       " MB; give fewer --directions or --source traced");
}

}  // namespace nephroid
