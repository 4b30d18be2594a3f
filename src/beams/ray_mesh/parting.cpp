// Sheets of light parted where their paths part.
#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "beams/ray_mesh/light_sheets.h"

namespace nephroid {
namespace {

constexpr int kMostHalvings = 4;  // of a side, to where paths part
constexpr uint8_t kMostCuts = 7;  // of a sheet, before it is parted along straight lines
// Of the full flux, times the error: sheets that carry more are cut before they are parted along straight
// lines; and those that carry less are given to their corners.
constexpr float kHeavy = 1e-2f, kLight = 3e-4f;
// Where light is chaotic: after so many boundaries, and so many times as far apart as it began.
constexpr uint8_t kFirstChaotic = 3;
constexpr float kSpreadOfChaos = 1.6f;
// Of the full flux, times the error, and over the number of beams: sheets that carry more are cut before
// they become chaotic.
constexpr float kHeavyAhead = 1e-3f, kBeamsAhead = 8;
// Beams that a sheet of a caster's own triangle becomes, about.
constexpr float kBeamsOfFirst = 4;

struct SideKey {
  uint64_t corners, path;
  bool operator==(const SideKey&) const = default;
};
struct SideHash {
  std::size_t operator()(const SideKey& key) const {
    return std::size_t((key.corners * 0x9e3779b97f4a7c15u) ^ (key.path * 0xc2b2ae3d27d4eb4fu));
  }
};

// What the transmittance at the border of total reflection, near which it rises as a power of the distance,
// has to be taken for so that the mean of corners is right: from its value a little off the border, `near`,
// at `place` of the side, and that of the side's other end.
float borderTransmittance(float near, float far, float place) {
  if (near <= 0 || far <= near) return near;
  const float power = std::log(far / near) / -std::log(place);
  return std::clamp(far * (2 / (1 + power) - 1), near, far);
}

// How often the sides of a sheet are halved that carries `times` the light of the lightest that are: until
// what lies between is as little.
int halvingsOf(float times) {
  return std::clamp(int(std::ceil(std::log2(times))) + 1, 2, kMostHalvings);
}

}  // namespace

// Where along a side, from the corner of the lower number, paths part; and the last paths of either way.
struct LightSheets::SideCut {
  uint32_t node[2];
  float place[2] = {0, 1};
  vec2 weights[2];
  uint32_t triangle;
  uint32_t light;
  uint64_t path;
  uint8_t generation;
  uint32_t signature[2];
  int halvings = 1;          // that are worth it
  bool isAmongMore = false;  // a third way lies between the two
  float middle() const { return 0.5f * (place[0] + place[1]); }
};

// lm. Of casters of so many triangles that the bound on beams will be met, no less than what a beam then has
// in the mean; and more after many boundaries, past which light is spread out.
float LightSheets::lightestParted(const Sheet& sheet) const {
  const float most = float(settings_.mostBeams);
  const float ofBeam = std::min(1.0f, kBeamsOfFirst * float(firstSheets_) / most) / most;
  const int spread = std::clamp(int(sheet.generation) - 2, 0, 4);
  return std::max(kLight * settings_.error, ofBeam) * fullFlux(sheet) * float(1 << (2 * spread));
}

// How far apart paths are, over how far apart they began.
float LightSheets::spreadAt(std::array<uint32_t, 3> nodes) const {
  const auto size = [&] {
    const auto at = [&](int i) { return tree.nodes[nodes[i]].position; };
    return std::max({distance(at(0), at(1)), distance(at(1), at(2)), distance(at(2), at(0))});
  };
  const float there = size();
  for (uint32_t& node : nodes) node = firstOfCorner_[tree.nodes[node].corner];
  return there / std::max(size(), 1e-30f);
}

bool LightSheets::isChaotic(const Sheet& sheet) const {
  if (sheet.generation < kFirstChaotic) return false;
  std::array<uint32_t, 3> at{sheet.node[0], sheet.node[1], sheet.node[2]};
  const auto nodeAt = [&](int i) -> const PathNode& { return tree.nodes[at[i]]; };
  // The last boundary that all three met in the same way.
  uint8_t last = std::min({nodeAt(0).generation, nodeAt(1).generation, nodeAt(2).generation});
  do {
    if (last == 0) return false;
    --last;
    for (uint32_t& node : at)
      while (tree.nodes[node].generation > last) node = tree.nodes[node].parent;
  } while (nodeAt(0).signature != nodeAt(1).signature || nodeAt(0).signature != nodeAt(2).signature);
  return spreadAt(at) > kSpreadOfChaos;
}

// Whether a sheet that is one way up to this boundary, and will be chaotic beyond, carries so much that it is
// cut here, before it is known where its parts go.
bool LightSheets::isCutAhead(const Sheet& sheet) const {
  const PathNode& node = tree.nodes[sheet.node[0]];
  if (sheet.cuts >= kMostCuts || node.generation + 1 < kFirstChaotic) return false;
  const float least = std::max(kHeavyAhead * settings_.error, kBeamsAhead / float(settings_.mostBeams));
  return luminanceOf(carried(sheet)) > least * fullFlux(sheet) &&
         spreadAt({sheet.node[0], sheet.node[1], sheet.node[2]}) > kSpreadOfChaos;
}

// Paths of corners stand for the light about them. Where paths go apart as by chance, new ones between them,
// asked for since these differ, would make the ways that most take more frequent than they are.
void LightSheets::part(std::span<const Sheet> mixed, std::vector<Sheet>& next) {
  if (mixed.empty()) return;
  std::vector<Sheet> heavy, clipped, ones, chaotic;
  for (const Sheet& sheet : mixed) {
    const float leastCut = kHeavy * settings_.error * fullFlux(sheet);
    uint32_t signature[3];
    for (int i = 0; i < 3; ++i) signature[i] = tree.nodes[sheet.node[i]].signature;
    const float most = mostCarried(sheet);
    const float light = lightestParted(sheet);
    const bool areTwo =
        signature[0] == signature[1] || signature[1] == signature[2] || signature[2] == signature[0];
    const bool isHeavy = sheet.cuts < kMostCuts && most > (areTwo ? std::max(leastCut, light) : 10 * light);
    if (most > light && isChaotic(sheet)) {
      chaotic.push_back(sheet);
    } else if (most > light && isHeavy) {
      heavy.push_back(sheet);
    } else if (most > light && areTwo && sheet.cuts < kMostCuts + 2) {
      clipped.push_back(sheet);
    } else {
      ones.push_back(sheet);
    }
  }
  cut(heavy, next);
  clip(clipped, ones, next);
  giveToEach(chaotic, next);
  giveToOnes(ones, next);
}

// lm, of the brightest of its paths.
float LightSheets::mostCarried(const Sheet& sheet) const {
  float most = 0;
  for (const uint32_t index : sheet.node) {
    const PathNode& node = tree.nodes[index];
    if (!carriesNone(index)) most = std::max(most, luminanceOf(sheet.flux * node.transmittance));
  }
  return most;
}

// A corner's path alone, with all of a sheet's light.
Sheet LightSheets::pathOfCorner(const Sheet& sheet, int corner) const {
  const auto begin = [&](int i) {
    return tree.nodes[firstOfCorner_[tree.nodes[sheet.node[i % 3]].corner]].position;
  };
  Sheet one = sheet;
  one.cuts = kWhole;
  // Light from a curved surface is the wider the more boundaries it has met; facets leave it as it is.
  const bool spreads = !isFacetedAt(tree.nodes[sheet.node[corner]]);
  one.bend = 0.5f * distance(begin(corner + 1), begin(corner + 2)) *
             float(1 << (spreads ? std::clamp(int(sheet.generation) - 1, 0, 30) : 0));
  for (int j = 0; j < 3; ++j) {
    one.node[j] = sheet.node[corner];
    one.weights[j] = sheet.weights[corner];
  }
  return one;
}

bool LightSheets::carriesNone(uint32_t node) const {
  return tree.nodes[node].state == PathState::dark || tree.nodes[node].state == PathState::lost;
}

// The path of one corner, at random, takes all of the light of each.
void LightSheets::giveToOnes(std::span<const Sheet> sheets, std::vector<Sheet>& next) {
  for (const Sheet& sheet : sheets) {
    const auto cornerOf = [&](int i) { return tree.nodes[sheet.node[i]].corner; };
    const int corner =
        int(3 * chance(cornerOf(0) ^ cornerOf(2) * 0x9e3779b9u, cornerOf(1) + sheet.generation));
    if (!carriesNone(sheet.node[corner])) next.push_back(pathOfCorner(sheet, corner));
  }
}

// The path of each corner takes a third of the light.
void LightSheets::giveToEach(std::span<const Sheet> sheets, std::vector<Sheet>& next) {
  for (const Sheet& sheet : sheets)
    for (int corner = 0; corner < 3; ++corner) {
      if (carriesNone(sheet.node[corner])) continue;
      Sheet& one = next.emplace_back(pathOfCorner(sheet, corner));
      one.flux /= 3.0f;
      one.gain /= 3.0f;
    }
}

void LightSheets::clip(std::span<const Sheet> mixed, std::vector<Sheet>& ones, std::vector<Sheet>& next) {
  if (mixed.empty()) return;
  std::vector<SideCut> sides;
  std::unordered_map<SideKey, uint32_t, SideHash> known;
  struct Clipped {
    int alone = 0;
    uint32_t side[2];  // toward the corner after the one that is alone, and the one before
    bool isTurned[2];  // whether the side begins at the other end
  };
  std::vector<Clipped> clipped(mixed.size());
  int mostHalvings = 1;
  for (std::size_t s = 0; s < mixed.size(); ++s) {
    const Sheet& sheet = mixed[s];
    const int halvings = halvingsOf(mostCarried(sheet) / lightestParted(sheet));
    mostHalvings = std::max(mostHalvings, halvings);
    const auto signatureAt = [&](int i) { return tree.nodes[sheet.node[i % 3]].signature; };
    int alone = 0;
    while (signatureAt(alone + 1) != signatureAt(alone + 2)) ++alone;
    clipped[s].alone = alone;
    for (int k = 0; k < 2; ++k) {
      const int other = (alone + 1 + k) % 3;
      const uint32_t a = tree.nodes[sheet.node[alone]].corner, b = tree.nodes[sheet.node[other]].corner;
      const bool isTurned = b < a;
      const SideKey key{isTurned ? uint64_t(b) << 32 | a : uint64_t(a) << 32 | b,
                        sheet.path | uint64_t(sheet.generation) << 56};
      const auto [found, isNew] = known.try_emplace(key, uint32_t(sides.size()));
      clipped[s].side[k] = found->second;
      clipped[s].isTurned[k] = isTurned;
      if (!isNew) {
        sides[found->second].halvings = std::max(sides[found->second].halvings, halvings);
        continue;
      }
      SideCut side{};
      for (int end = 0; end < 2; ++end) {
        const int corner = (end == 1) != isTurned ? other : alone;
        side.node[end] = sheet.node[corner];
        side.weights[end] = sheet.weights[corner];
        side.signature[end] = signatureAt(corner);
      }
      side.place[0] = 0;
      side.place[1] = 1;
      side.triangle = sheet.triangle;
      side.light = sheet.light;
      side.path = sheet.path;
      side.generation = sheet.generation;
      side.halvings = halvings;
      sides.push_back(side);
    }
  }
  std::vector<PathAsk> asks;
  std::vector<uint32_t> asking;
  for (int halving = 0; halving < mostHalvings; ++halving) {
    asks.clear();
    asking.clear();
    for (uint32_t i = 0; i < sides.size(); ++i) {
      const SideCut& side = sides[i];
      if (halving >= side.halvings) continue;
      asks.push_back(
          {addCorner({side.light, side.triangle, mix(side.weights[0], side.weights[1], side.middle())}),
           side.path, side.generation});
      asking.push_back(i);
    }
    reach(asks);
    for (std::size_t i = 0; i < asks.size(); ++i) {
      SideCut& side = sides[asking[i]];
      const uint32_t signature = tree.nodes[asks[i].node].signature;
      const int end = signature == side.signature[0] ? 0 : 1;
      side.place[end] = side.middle();
      if (signature == side.signature[end]) {
        side.node[end] = asks[i].node;
      } else {
        side.isAmongMore = true;
      }
    }
  }
  std::vector<Sheet> chaotic;
  for (std::size_t s = 0; s < mixed.size(); ++s) {
    const Sheet& whole = mixed[s];
    const Clipped& how = clipped[s];
    if (sides[how.side[0]].isAmongMore || sides[how.side[1]].isAmongMore) {
      if (whole.cuts < kMostCuts && luminanceOf(carried(whole)) > 10 * lightestParted(whole)) {
        chaotic.push_back(whole);
      } else {
        ones.push_back(whole);
      }
      continue;
    }
    uint32_t own[2], others[2];
    float ownGain[2], othersGain[2];
    vec2 border[2];
    for (int k = 0; k < 2; ++k) {
      const SideCut& side = sides[how.side[k]];
      const int ownEnd = how.isTurned[k] ? 1 : 0;
      own[k] = side.node[ownEnd];
      others[k] = side.node[1 - ownEnd];
      const float place = how.isTurned[k] ? 1 - side.middle() : side.middle();
      const float placeOfNear = 0.5f * (side.place[1] - side.place[0]);
      const auto gain = [&](uint32_t near, uint32_t far, uint32_t beyond) {
        if (tree.nodes[beyond].state != PathState::lost) return 0.0f;
        const float atNear = luminanceOf(tree.nodes[near].transmittance);
        return borderTransmittance(atNear, luminanceOf(tree.nodes[far].transmittance), placeOfNear) - atNear;
      };
      const uint32_t far = whole.node[how.alone], other = whole.node[(how.alone + 1 + k) % 3];
      ownGain[k] = gain(own[k], far, other);
      othersGain[k] = gain(others[k], other, far);
      border[k] = mix(whole.weights[how.alone], whole.weights[(how.alone + 1 + k) % 3], place);
    }
    const int x = how.alone, y = (x + 1) % 3, z = (x + 2) % 3;
    const auto add = [&](std::array<uint32_t, 3> nodes, std::array<vec2, 3> weights, float gain) {
      Sheet sheet = whole;
      sheet.cuts = uint8_t(whole.cuts + 1);
      for (int i = 0; i < 3; ++i) {
        sheet.node[i] = nodes[i];
        sheet.weights[i] = weights[i];
      }
      float sum = 0;
      for (const uint32_t node : nodes) sum += luminanceOf(tree.nodes[node].transmittance);
      if (gain > 0 && sum > 0) sheet.gain *= 1 + gain / sum;
      sheet.flux = fluxOf(sheet);
      if (sheet.flux.x + sheet.flux.y + sheet.flux.z > 0) next.push_back(sheet);
    };
    add({whole.node[x], own[0], own[1]}, {whole.weights[x], border[0], border[1]}, ownGain[0] + ownGain[1]);
    add({others[0], whole.node[y], whole.node[z]}, {border[0], whole.weights[y], whole.weights[z]},
        othersGain[0]);
    add({others[0], whole.node[z], others[1]}, {border[0], whole.weights[z], border[1]},
        othersGain[0] + othersGain[1]);
  }
  cut(chaotic, next);
}

}  // namespace nephroid
