#include "irradiance_volume/flow.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "irradiance_volume/grid.h"
#include "irradiance_volume/light_samples.h"
#include "irradiance_volume/photons.h"

namespace nephroid {
namespace {

constexpr uint32_t kMostSide = 8;
constexpr std::size_t kPartOfBytes = 8;  // of a sample's bytes that movements may take
constexpr uint32_t kWordsBefore = 6;     // the lattice's corner and spacing
constexpr uint32_t kWordsOfNode = 3;     // six half floats

constexpr uint32_t kPairedPhotons = 8000;
constexpr int kStepsAlongPath = 16;
constexpr float kMostChange = 10;  // of a pair, for each radian that the light turned
constexpr float kSmoothness =
    0.05f;  // weight of a node's neighbors, relative to the mean weight of the nodes' own values
constexpr int kSmoothings = 40;
constexpr std::size_t kCellsJudged = 20 * 20 * 20;

using Moves = std::array<std::vector<vec3>, 2>;  // of all nodes, for both ways of the light

struct FlowLattice {
  vec3 corner;
  vec3 spacing;
  uint32_t side;

  std::size_t count() const { return std::size_t{side} * side * side; }
  uvec3 node(std::size_t i) const { return {i % side, i / side % side, i / side / side}; }
  vec3 place(std::size_t i) const { return corner + spacing * vec3(node(i)); }
  std::size_t index(uvec3 n) const { return (std::size_t{n.z} * side + n.y) * side + n.x; }

  // Nodes around a place and their linear weights.
  template <class Visit>
  void around(vec3 place, const Visit& visit) const {
    const vec3 at = clamp((place - corner) / spacing, vec3(0), vec3(float(side - 1)));
    const uvec3 low = min(uvec3(at), uvec3(side - 2));
    const vec3 part = at - vec3(low);
    for (uint32_t i = 0; i < 8; ++i) {
      const uvec3 bit(i & 1u, (i >> 1) & 1u, i >> 2);
      const vec3 weights = mix(1.0f - part, part, vec3(bit));
      visit(index(low + bit), weights.x * weights.y * weights.z);
    }
  }
};

// Turned from the sample's direction by `aside`; the frame turns with it.
mat3 turnedFrame(const mat3& frame, vec2 aside) {
  const vec3 direction = normalize(frame * vec3(aside, std::sqrt(std::max(0.0f, 1 - dot(aside, aside)))));
  return turnBetween(frame[2], direction) * frame;
}

// What stays a photon's own while the light turns.
enum class Label { place, entry, exit };

// Sums over the paths by node: of the projections across them, and of their displacements so projected.
struct Sums {
  std::vector<mat3> across;
  std::array<std::vector<vec3>, 2> displacement;
};

void addPair(const PhotonPath& from, const PhotonPath& to, int way, float step, const FlowLattice& lattice,
             Sums& sums) {
  const float length = std::min(from.length, to.length);
  const mat3 across = mat3(1) - glm::outerProduct(from.direction, from.direction);
  const float weight = brightness(from) * length;
  for (int i = 0; i < kStepsAlongPath; ++i) {
    const float along = length * (float(i) + 0.5f) / kStepsAlongPath;
    const vec3 place = from.origin + along * from.direction;
    const vec3 change = across * (place - to.origin - along * to.direction) / step;
    lattice.around(place, [&](std::size_t node, float share) {
      sums.across[node] += weight * share * across;
      sums.displacement[std::size_t(way)][node] += weight * share * change;
    });
  }
}

// Displacements that fit those of the paths, and where there are few those of the nodes around.
Moves solve(const FlowLattice& lattice, const Sums& sums) {
  Moves moves;
  float trace = 0;
  for (const mat3& m : sums.across) trace += (m[0][0] + m[1][1] + m[2][2]) / 3;
  const float smoothness = kSmoothness * trace / float(lattice.count());
  for (std::size_t way = 0; way < 2; ++way) {
    std::vector<vec3>& now = moves[way];
    now.assign(lattice.count(), vec3(0));
    std::vector<vec3> next = now;
    for (int round = 0; round < kSmoothings && smoothness > 0; ++round) {
      for (std::size_t i = 0; i < now.size(); ++i) {
        const uvec3 node = lattice.node(i);
        vec3 around(0);
        float count = 0;
        for (int axis = 0; axis < 3; ++axis)
          for (const uint32_t neighbor : {node[axis] - 1, node[axis] + 1}) {
            if (neighbor >= lattice.side) continue;
            uvec3 other = node;
            other[axis] = neighbor;
            around += now[lattice.index(other)];
            ++count;
          }
        // Every pair of opposite directions counted its projection once for each way.
        next[i] = glm::inverse(0.5f * sums.across[i] + mat3(smoothness)) *
                  (sums.displacement[way][i] + smoothness * around / count);
      }
      std::swap(now, next);
    }
  }
  return moves;
}

// What the light's own movement would be if it stayed where it is while the frame turns.
Moves standing(const FlowLattice& lattice) {
  Moves moves;
  for (std::size_t i = 0; i < lattice.count(); ++i) {
    moves[0].push_back(cross(vec3(0, 1, 0), lattice.place(i)));
    moves[1].push_back(cross(vec3(-1, 0, 0), lattice.place(i)));
  }
  return moves;
}

LightFlow turnedBy(const FlowLattice& lattice, const Moves& moves, vec2 aside) {
  LightFlow flow{lattice.corner, 1.0f / lattice.spacing, lattice.side, {}};
  for (std::size_t i = 0; i < lattice.count(); ++i)
    flow.moves.push_back(aside.x * moves[0][i] + aside.y * moves[1][i]);
  return flow;
}

// Light on a grid of cells, looked up between their centers.
class Cells {
 public:
  Cells(std::span<const PhotonPath> paths, const SampleLayout& layout)
      : layout_(layout), sums_(gridSums(paths, layout)) {}

  vec3 vector(std::size_t cell) const { return sums_[cell].vector; }
  vec3 placeOf(std::size_t cell) const {
    const uvec3 size = layout_.size;
    const uvec3 at(cell % size.x, cell / size.x % size.y, cell / size.x / size.y);
    return layout_.corner + (vec3(at) + 0.5f) / layout_.placesPerUnit;
  }
  std::size_t count() const { return sums_.size(); }
  vec3 at(vec3 place) const {
    const vec3 inCells = (place - layout_.corner) * layout_.placesPerUnit - 0.5f;
    const ivec3 low(floor(inCells));
    const vec3 part = inCells - vec3(low);
    vec3 sum(0);
    for (int i = 0; i < 8; ++i) {
      const ivec3 bit(i & 1, (i >> 1) & 1, i >> 2);
      const ivec3 cell = low + bit;
      if (glm::any(glm::lessThan(cell, ivec3(0))) ||
          glm::any(glm::greaterThanEqual(cell, ivec3(layout_.size))))
        continue;
      const vec3 weights = mix(1.0f - part, part, vec3(bit));
      const uvec3 c(cell);
      sum += weights.x * weights.y * weights.z *
             sums_[(std::size_t{c.z} * layout_.size.y + c.y) * layout_.size.x + c.x].vector;
    }
    return sum;
  }

 private:
  SampleLayout layout_;
  std::vector<CellSum> sums_;
};

// A direction that movements are judged by, and the light traced for it.
struct Trial {
  vec2 aside;
  Cells light;
};

// By node, the squared difference of the sample so moved to what was traced.
std::vector<double> misfit(const FlowLattice& lattice, const Moves& moves, const Cells& sample,
                           std::span<const Trial> trials) {
  std::vector<double> sums(lattice.count(), 0);
  for (const Trial& trial : trials) {
    const LightFlow flow = turnedBy(lattice, moves, trial.aside);
    for (std::size_t cell = 0; cell < trial.light.count(); ++cell) {
      const vec3 place = sample.placeOf(cell);
      const FlowedPlace from = flowedPlace(viewOf(flow), place);
      const vec3 difference = carried(from, sample.at(from.place)) - trial.light.vector(cell);
      if (difference == vec3(0)) continue;
      const double square = double(dot(difference, difference));
      lattice.around(place, [&](std::size_t node, float share) { sums[node] += double(share) * square; });
    }
  }
  return sums;
}

double sumOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

// At every node the movement that fits best around it, unless a single one fits better altogether.
Moves bestOf(const FlowLattice& lattice, const std::vector<Moves>& candidates, const Cells& sample,
             std::span<const Trial> trials) {
  std::vector<std::vector<double>> around;
  double least = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    std::vector<double> misfits = misfit(lattice, candidates[c], sample, trials);
    if (sumOf(misfits) < least) {
      least = sumOf(misfits);
      best = c;
    }
    around.push_back(std::move(misfits));
  }
  Moves mixed = candidates[best];
  for (std::size_t i = 0; i < lattice.count(); ++i) {
    std::size_t chosen = best;
    for (std::size_t c = 0; c < candidates.size(); ++c)
      if (around[c][i] < around[chosen][i]) chosen = c;
    for (std::size_t way = 0; way < 2; ++way) mixed[way][i] = candidates[chosen][way][i];
  }
  return sumOf(misfit(lattice, mixed, sample, trials)) < least ? mixed : candidates[best];
}

FlowLattice latticeAround(std::span<const PhotonPath> paths, uint32_t side) {
  const LitBox box = litBox(paths);
  return {box.low, max(box.high - box.low, vec3(1e-3f)) / float(side - 1), side};
}

std::array<vec2, 4> asides(float angle) {
  const float a = std::sin(angle);
  return {vec2(a, 0), vec2(-a, 0), vec2(0, a), vec2(0, -a)};
}

std::vector<Moves> tracedMoves(const CasterTracer& tracer, const mat3& frame, const FlowLattice& lattice,
                               const FlowSettings& settings) {
  std::array<Sums, 3> sums;
  for (Sums& one : sums) {
    one.across.assign(lattice.count(), mat3(0));
    one.displacement.fill(std::vector<vec3>(lattice.count(), vec3(0)));
  }
  const float angle = 0.5f * settings.angle;
  for (const vec2 aside : asides(angle)) {
    const mat3 turned = turnedFrame(frame, aside);
    const int way = aside.x == 0 ? 1 : 0;
    const float step = aside.x + aside.y;
    const auto add = [&](Label label, const std::vector<PhotonPair>& pairs) {
      for (const auto& [from, found] : pairs) {
        PhotonPath to = found;
        if (label == Label::exit) to.origin = glm::transpose(turned) * frame * from.origin;
        const float most = kMostChange * angle;
        if (length(from.origin - to.origin) < most && length(from.direction - to.direction) < most)
          addPair(from, to, way, step, lattice, sums[std::size_t(label)]);
      }
    };
    add(Label::place, tracer.pairs(frame, turned, PairedBy::place, kPairedPhotons, settings.reach));
    const std::vector<PhotonPair> byEntry =
        tracer.pairs(frame, turned, PairedBy::entry, kPairedPhotons, settings.reach);
    add(Label::entry, byEntry);
    add(Label::exit, byEntry);
  }
  std::vector<Moves> moves;
  for (const Sums& one : sums) moves.push_back(solve(lattice, one));
  return moves;
}

}  // namespace

uint32_t flowSide(std::size_t bytes) {
  const double nodes = double(bytes / kPartOfBytes) / (kWordsOfNode * sizeof(uint32_t));
  return std::clamp(uint32_t(std::cbrt(nodes)), 2u, kMostSide);
}

std::size_t flowWordCount(uint32_t side) {
  return side == 0 ? 0 : kWordsBefore + std::size_t{kWordsOfNode} * side * side * side;
}

std::vector<uint32_t> traceFlow(const CasterTracer& tracer, const mat3& frame,
                                std::span<const PhotonPath> paths, const FlowSettings& settings) {
  if (paths.empty()) return {};
  const FlowLattice lattice = latticeAround(paths, settings.side);
  std::vector<Moves> candidates = tracedMoves(tracer, frame, lattice, settings);
  candidates.push_back(standing(lattice));
  candidates.push_back(
      {std::vector<vec3>(lattice.count(), vec3(0)), std::vector<vec3>(lattice.count(), vec3(0))});

  const SampleLayout judged = gridAround(litBox(paths), kCellsJudged);
  const Cells sample(paths, judged);
  std::vector<Trial> trials;
  for (const vec2 aside : asides(0.7f * settings.angle))
    trials.push_back(
        {aside, Cells(tracer.trace(turnedFrame(frame, aside), settings.photons, settings.reach), judged)});
  const Moves moves = bestOf(lattice, candidates, sample, trials);

  std::vector<uint32_t> words;
  for (const vec3& v : {lattice.corner, lattice.spacing})
    for (int axis = 0; axis < 3; ++axis) words.push_back(std::bit_cast<uint32_t>(v[axis]));
  for (std::size_t i = 0; i < lattice.count(); ++i) {
    const vec3 a = moves[0][i], b = moves[1][i];
    for (const vec2 pair : {vec2(a), vec2(a.z, b.x), vec2(b.y, b.z)})
      words.push_back(glm::packHalf2x16(pair));
  }
  return words;
}

LightFlow flowFor(const SampleLayout& layout, std::span<const uint32_t> words, vec2 aside) {
  LightFlow flow;
  if (layout.flowSide == 0 || aside == vec2(0)) return flow;
  const std::span<const uint32_t> own = words.last(flowWordCount(layout.flowSide));
  const auto vectorAt = [&](std::size_t i) {
    return vec3(uintBitsToFloat(own[i]), uintBitsToFloat(own[i + 1]), uintBitsToFloat(own[i + 2]));
  };
  flow.origin = (vectorAt(0) - layout.corner) * layout.placesPerUnit;
  flow.scale = 1.0f / (vectorAt(3) * layout.placesPerUnit);
  flow.side = layout.flowSide;
  for (std::size_t i = kWordsBefore; i < own.size(); i += kWordsOfNode) {
    const vec2 first = unpackHalf2x16(own[i]), middle = unpackHalf2x16(own[i + 1]),
               last = unpackHalf2x16(own[i + 2]);
    flow.moves.push_back(layout.placesPerUnit *
                         (aside.x * vec3(first, middle.x) + aside.y * vec3(middle.y, last)));
  }
  return flow;
}

}  // namespace nephroid
