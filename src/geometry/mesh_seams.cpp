// Seams of a mesh that are open only by the rounding of coordinates.
#include <algorithm>
#include <limits>
#include <unordered_map>
#include <vector>

#include "geometry/mesh_repairs.h"
#include "geometry/triangle_area.h"

namespace nephroid {
namespace {

constexpr double kSeamInEpsilons = 4;  // of the mesh's largest coordinate
constexpr double kSeamInShort = 0.1;   // of its short sides
constexpr std::size_t kOneOf = 10;     // sides is as short as that, or shorter

// m. A tenth of the triangles' sides are no longer. Not the shortest of all: at a ball's pole a seam itself
// makes sides as short as it is wide.
double shortSide(const Mesh& mesh) {
  std::vector<float> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (const uvec3& t : mesh.triangles)
    for (int k = 0; k < 3 && !hasNoArea(mesh, t); ++k)
      sides.push_back(glm::distance(mesh.positions[t[k]], mesh.positions[t[(k + 1) % 3]]));
  if (sides.empty()) return 0;
  const auto at = sides.begin() + std::ptrdiff_t(sides.size() / kOneOf);
  std::nth_element(sides.begin(), at, sides.end());
  return double(*at);
}

// m
double widestSeam(const Mesh& mesh) {
  float largest = 0;
  for (const vec3& p : mesh.positions) {
    const vec3 size = abs(p);
    largest = std::max({largest, size.x, size.y, size.z});
  }
  const double rounding = kSeamInEpsilons * double(std::numeric_limits<float>::epsilon()) * double(largest);
  return std::min(rounding, kSeamInShort * shortSide(mesh));
}

using Cell = glm::i64vec3;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    uint64_t hash = 0x9e3779b97f4a7c15ull;
    for (int k = 0; k < 3; ++k) hash = (hash ^ uint64_t(cell[k])) * 0x100000001b3ull + (hash >> 29);
    return hash;
  }
};

// Finds points within a distance of others.
class NearPoints {
 public:
  NearPoints(const std::vector<vec3>& positions, double distance)
      : positions_(positions), distance_(distance) {}

  // A point added before that is near `point`, else `point` itself, which is then added.
  uint32_t nearOrAdded(uint32_t point) {
    const glm::dvec3 place = positions_[point];
    const Cell low = cellAt(place - distance_), high = cellAt(place + distance_);
    for (int64_t x = low.x; x <= high.x; ++x)
      for (int64_t y = low.y; y <= high.y; ++y)
        for (int64_t z = low.z; z <= high.z; ++z) {
          const auto [first, last] = cells_.equal_range({x, y, z});
          for (auto at = first; at != last; ++at)
            if (glm::distance(glm::dvec3(positions_[at->second]), place) <= distance_) return at->second;
        }
    cells_.emplace(cellAt(place), point);
    return point;
  }

 private:
  Cell cellAt(glm::dvec3 place) const { return Cell(glm::floor(place / (2 * distance_))); }

  const std::vector<vec3>& positions_;
  double distance_;
  std::unordered_multimap<Cell, uint32_t, CellHash> cells_;
};

// The places at edges with one face, in ascending order.
std::vector<uint32_t> openPlaces(const Mesh& mesh, const MeshEdges& edges,
                                 const std::vector<uint32_t>& joined) {
  std::vector<uint32_t> places;
  for (std::size_t edge = 0; edge < edges.count(); ++edge) {
    const auto sides = edges.sidesOf(edge);
    if (sides.size() != 1) continue;
    const uvec3& t = mesh.triangles[sides[0] / 3];
    const int k = int(sides[0] % 3);
    places.push_back(joined[t[k]]);
    places.push_back(joined[t[(k + 1) % 3]]);
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

}  // namespace

bool closeSeams(Mesh& mesh, const MeshEdges& edges, std::vector<uint32_t>& joined) {
  const std::vector<uint32_t> open = openPlaces(mesh, edges, joined);
  if (open.empty()) return false;
  const double width = widestSeam(mesh);
  if (!(width > 0)) return false;
  NearPoints near(mesh.positions, width);
  std::unordered_map<uint32_t, uint32_t> moved;
  for (const uint32_t place : open) {
    const uint32_t other = near.nearOrAdded(place);
    if (other != place) moved.emplace(place, other);
  }
  if (moved.empty()) return false;
  for (std::size_t i = 0; i < joined.size(); ++i) {
    const auto found = moved.find(joined[i]);
    if (found == moved.end()) continue;
    joined[i] = found->second;
    mesh.positions[i] = mesh.positions[found->second];
  }
  return true;
}

}  // namespace nephroid
