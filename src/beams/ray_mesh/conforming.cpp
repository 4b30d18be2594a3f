// A mesh of rays made conforming: a sheet next to finer ones is divided where these have a corner on its
// side, so that light lands without cracks between them (red-green refinement, Bank and Sherman 1981).
#include <oneapi/tbb/parallel_for.h>

#include "beams/ray_mesh/light_sheets.h"

namespace nephroid {

// The path from the middle of a sheet's side, which begins at corner `side`: where it stands beside the
// sheet's own paths; kNone where no finer sheet has it there.
uint32_t LightSheets::middleOf(const Sheet& sheet, int side) const {
  const PathNode &a = tree.nodes[sheet.node[side]], &b = tree.nodes[sheet.node[(side + 1) % 3]];
  const uint32_t corner = middles_[sheet.light].find(a.corner, b.corner);
  if (corner == EdgeTable::kEmpty) return kNone;
  uint32_t node = firstOfCorner_[corner];
  for (uint8_t generation = 0; generation < a.generation && node != kNone; ++generation)
    node = tree.nodes[node].child[sheet.path >> generation & 1u];
  if (node == kNone || tree.nodes[node].signature != a.signature) return kNone;
  return tree.nodes[node].state == PathState::arrived ? node : kNone;
}

void LightSheets::addConforming(const Sheet& sheet, std::vector<Sheet>& conforming) const {
  uint32_t middle[3] = {kNone, kNone, kNone};
  int count = 0;
  if (sheet.cuts != kWhole)
    for (int i = 0; i < 3; ++i) {
      middle[i] = middleOf(sheet, i);
      count += middle[i] != kNone;
    }
  if (count == 0) return conforming.push_back(sheet);
  uint32_t node[6];
  vec2 weights[6];
  for (int i = 0; i < 3; ++i) {
    node[i] = sheet.node[i];
    weights[i] = sheet.weights[i];
    node[3 + i] = middle[i];
    weights[3 + i] = 0.5f * (sheet.weights[i] + sheet.weights[(i + 1) % 3]);
  }
  const auto add = [&](int a, int b, int c) {
    Sheet part = sheet;
    const int corners[3] = {a, b, c};
    for (int i = 0; i < 3; ++i) {
      part.node[i] = node[corners[i]];
      part.weights[i] = weights[corners[i]];
    }
    part.flux = fluxOf(part);
    addConforming(part, conforming);
  };
  if (count == 3) {
    add(0, 3, 5);
    add(3, 1, 4);
    add(5, 4, 2);
    return add(3, 4, 5);
  }
  // The side that stands for the others: the one that is divided, or the one that is not.
  int side = 0;
  while ((middle[side] != kNone) != (count == 1)) ++side;
  const int a = side, b = (side + 1) % 3, c = (side + 2) % 3;
  if (count == 1) {
    add(a, 3 + side, c);
    return add(3 + side, b, c);
  }
  add(a, b, 3 + b);
  add(a, 3 + b, 3 + c);
  add(3 + c, 3 + b, c);
}

void LightSheets::conform(std::vector<Sheet>& landed) const {
  constexpr std::size_t kChunk = 2048;
  std::vector<std::vector<Sheet>> chunks((landed.size() + kChunk - 1) / kChunk);
  oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t chunk) {
    const std::size_t end = std::min(landed.size(), (chunk + 1) * kChunk);
    chunks[chunk].reserve(kChunk + kChunk / 4);
    for (std::size_t i = chunk * kChunk; i < end; ++i) addConforming(landed[i], chunks[chunk]);
  });
  landed.clear();
  for (std::vector<Sheet>& chunk : chunks) {
    landed.insert(landed.end(), chunk.begin(), chunk.end());
    chunk = {};
  }
}

}  // namespace nephroid
