// Triangles that stand twice.
#include <algorithm>
#include <array>
#include <numeric>

#include "geometry/mesh_repairs.h"
#include "geometry/triangle_area.h"

namespace nephroid {
namespace {

// Sets of triangles that grow together.
class TriangleSets {
 public:
  explicit TriangleSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  uint32_t of(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) { parent_[of(b)] = of(a); }

 private:
  std::vector<uint32_t> parent_;
};

constexpr uint32_t kAlone = UINT32_MAX;

class RepeatedTriangles {
 public:
  RepeatedTriangles(const Mesh& mesh, const MeshEdges& edges, const std::vector<uint32_t>& joined)
      : mesh_(mesh), edges_(edges), joined_(joined) {}

  // True for the triangles to be left out; empty where there are none.
  std::vector<bool> find() {
    const std::vector<uint32_t> suspects = suspectTriangles();
    if (suspects.empty()) return {};
    isRepeated_.assign(mesh_.triangles.size(), false);
    reversed_.assign(mesh_.triangles.size(), kAlone);
    const bool hasPairs = compare(suspects);
    if (hasPairs) judgePairs();
    return std::move(isRepeated_);
  }

 private:
  uint32_t placeOpposite(uint32_t side) const {
    return joined_[mesh_.triangles[side / 3][int(side % 3 + 2) % 3]];
  }

  // Those that share an edge with more than one other, or an edge and the third corner with one.
  std::vector<uint32_t> suspectTriangles() const {
    std::vector<uint32_t> suspects;
    for (std::size_t edge = 0; edge < edges_.count(); ++edge) {
      const auto sides = edges_.sidesOf(edge);
      if (sides.size() < 2) continue;
      if (sides.size() == 2 && placeOpposite(sides[0]) != placeOpposite(sides[1])) continue;
      for (const uint32_t side : sides) suspects.push_back(side / 3);
    }
    std::sort(suspects.begin(), suspects.end());
    suspects.erase(std::unique(suspects.begin(), suspects.end()), suspects.end());
    return suspects;
  }

  struct Entry {
    std::array<uint32_t, 3> places;  // in ascending order
    bool runsUp;                     // through them, or the other way round
    uint32_t triangle;
    bool operator<(const Entry& other) const {
      return places != other.places ? places < other.places : triangle < other.triangle;
    }
  };

  Entry entryOf(uint32_t triangle) const {
    const uvec3& t = mesh_.triangles[triangle];
    std::array places{joined_[t.x], joined_[t.y], joined_[t.z]};
    std::rotate(places.begin(), std::ranges::min_element(places), places.end());
    const bool runsUp = places[1] < places[2];
    if (!runsUp) std::swap(places[1], places[2]);
    return {places, runsUp, triangle};
  }

  // Marks those that stand there again in the same way, and pairs those that run against each other. Whether
  // there are pairs.
  bool compare(const std::vector<uint32_t>& suspects) {
    std::vector<Entry> entries;
    for (const uint32_t triangle : suspects) entries.push_back(entryOf(triangle));
    std::sort(entries.begin(), entries.end());
    bool hasPairs = false;
    for (std::size_t first = 0, last = 0; first < entries.size(); first = last) {
      uint32_t reversed = kAlone;
      for (last = first + 1; last < entries.size() && entries[last].places == entries[first].places; ++last) {
        const bool isReversed = entries[last].runsUp != entries[first].runsUp;
        if (isReversed && reversed == kAlone)
          reversed = entries[last].triangle;
        else
          isRepeated_[entries[last].triangle] = true;
      }
      if (reversed == kAlone) continue;
      hasPairs = true;
      reversed_[entries[first].triangle] = reversed;
      reversed_[reversed] = entries[first].triangle;
    }
    return hasPairs;
  }

  bool isPaired(uint32_t triangle) const { return reversed_[triangle] != kAlone; }

  void judgePairs() {
    const auto count = uint32_t(mesh_.triangles.size());
    TriangleSets pieces(count), sheets(count);  // of all triangles, and of paired ones
    for (uint32_t t = 0; t < count; ++t)
      if (isPaired(t)) sheets.join(t, reversed_[t]);
    std::vector<uint32_t> rims;  // a triangle of each sheet that ends where nothing else is
    for (std::size_t edge = 0; edge < edges_.count(); ++edge) {
      uint32_t others = 0, pairs = 0, lastPaired = kAlone;
      const uint32_t first = edges_.sidesOf(edge)[0] / 3;
      for (const uint32_t side : edges_.sidesOf(edge)) {
        const uint32_t t = side / 3;
        if (isRepeated_[t]) continue;
        pieces.join(first, t);
        if (!isPaired(t)) {
          ++others;
          continue;
        }
        if (lastPaired != kAlone) sheets.join(lastPaired, t);
        lastPaired = t;
        ++pairs;
      }
      if (others == 0 && pairs == 2) rims.push_back(lastPaired);
    }
    std::vector<bool> hasOthers(count, false), hasRim(count, false);
    for (uint32_t t = 0; t < count; ++t)
      if (!isRepeated_[t] && !isPaired(t) && pieceHasSides(t)) hasOthers[pieces.of(t)] = true;
    for (const uint32_t t : rims) hasRim[sheets.of(t)] = true;
    const std::vector<double> volumes = volumesOfFirst(pieces);
    for (uint32_t t = 0; t < count; ++t) {
      if (!isPaired(t)) continue;
      const bool isGlued = hasOthers[pieces.of(t)];
      if (isGlued && hasRim[sheets.of(t)]) continue;
      const bool isFirst = t < reversed_[t];
      isRepeated_[t] = isGlued || isFirst == (volumes[pieces.of(t)] < 0);
    }
  }

  // m3 that the first of each pair enclose in its piece: negative where they are the ones that look inward.
  std::vector<double> volumesOfFirst(TriangleSets& pieces) const {
    std::vector<double> volumes(mesh_.triangles.size(), 0);
    for (uint32_t t = 0; t < volumes.size(); ++t) {
      if (!isPaired(t) || reversed_[t] < t) continue;
      const glm::dvec3 corner = mesh_.positions[mesh_.triangles[t].x];
      volumes[pieces.of(t)] += glm::dot(corner, areaVector(mesh_, mesh_.triangles[t])) / 3;
    }
    return volumes;
  }

  // Triangles that use a place twice belong to no piece.
  bool pieceHasSides(uint32_t triangle) const {
    const uvec3& t = mesh_.triangles[triangle];
    return joined_[t.x] != joined_[t.y] && joined_[t.y] != joined_[t.z] && joined_[t.z] != joined_[t.x];
  }

  const Mesh& mesh_;
  const MeshEdges& edges_;
  const std::vector<uint32_t>& joined_;
  std::vector<bool> isRepeated_;
  std::vector<uint32_t> reversed_;  // the triangle on the same places that runs the other way
};

}  // namespace

bool dropRepeatedTriangles(Mesh& mesh, const MeshEdges& edges, const std::vector<uint32_t>& joined) {
  const std::vector<bool> isRepeated = RepeatedTriangles(mesh, edges, joined).find();
  const auto count = uint32_t(std::ranges::count(isRepeated, true));
  if (count == 0) return false;
  std::vector<uvec3> kept;
  for (std::size_t t = 0; t < isRepeated.size(); ++t)
    if (!isRepeated[t]) kept.push_back(mesh.triangles[t]);
  mesh.triangles = std::move(kept);
  mesh.findings.repeatedTriangles += count;
  return true;
}

}  // namespace nephroid
