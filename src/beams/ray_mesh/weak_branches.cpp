// Sheets of light that carry little: left out, or chosen by lot.
#include <algorithm>
#include <cmath>

#include "beams/ray_mesh/light_sheets.h"

namespace nephroid {
namespace {

// A branch that carries no more of the light that fed it is left out, as far as the error allows.
constexpr float kWeakBranch = 0.02f;
constexpr double kLeftOut = 0.07;  // of the error
// Of the full flux, times the error: less than this is not followed sheet by sheet.
constexpr float kLeastCarried = 2e-4f;
// Of light that is trapped there is no end: after so many boundaries kLeastCarried doubles with each
// kPartOfDoubling of the memory that paths take beyond kFreePart.
constexpr uint8_t kLongWay = 6;
constexpr float kFreePart = 0.25f, kPartOfDoubling = 1.0f / 32, kMostDoublings = 24;

}  // namespace

// Leaves branches out that carry little of the light that fed them, the weakest first, as far as the error
// allows; and those that carry nothing.
void LightSheets::prune(std::vector<Sheet>& sheets) {
  constexpr int kBuckets = 256;
  constexpr float kBucketsAnOctave = 8;
  std::vector<float> part(sheets.size());
  double inBucket[kBuckets] = {};
  const auto bucketOf = [&](float transmittance) {
    return int(glm::clamp(-std::log2(transmittance) * kBucketsAnOctave, 0.0f, float(kBuckets - 1)));
  };
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const float flux = luminanceOf(sheets[i].flux), left = luminanceOf(carried(sheets[i]));
    part[i] = flux > 0 ? left / flux : 0;
    if (part[i] > 0 && part[i] < kWeakBranch) inBucket[bucketOf(part[i])] += double(left);
  }
  double allowed = kLeftOut * double(settings_.error) * stats.incidentFlux - stats.droppedFlux;
  int last = kBuckets;  // the first that is left out
  while (last > 0 && allowed >= inBucket[last - 1]) allowed -= inBucket[--last];
  std::size_t kept = 0;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const bool isDropped = part[i] < kWeakBranch && (part[i] <= 0 || bucketOf(part[i]) >= last);
    if (isDropped) {
      stats.droppedFlux += double(luminanceOf(carried(sheets[i])));
    } else {
      sheets[kept++] = sheets[i];
    }
  }
  sheets.resize(kept);
}

// A path alone goes one way at each boundary, at random by what goes there, with the light of all; and of
// sheets that carry little some are taken out by lot, with their light given to the others: in the mean
// nothing is missing, and long ways of trapped light cost little.
void LightSheets::chooseAmongWeak(std::vector<Sheet>& children) {
  const float crowding = std::max(partOfMemory() - kFreePart, 0.0f) / kPartOfDoubling;
  const float crowded = std::exp2(std::min(crowding, kMostDoublings));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < children.size(); ++i) {
    Sheet child = children[i];
    const float least =
        kLeastCarried * settings_.error * fullFlux(child) * (child.generation > kLongWay ? crowded : 1);
    float left = luminanceOf(carried(child));
    if (!(left > 0)) continue;
    const PathNode& node = tree.nodes[child.node[0]];
    if (child.cuts == kWhole && i + 1 < children.size() && children[i + 1].cuts == kWhole &&
        tree.nodes[children[i + 1].node[0]].parent == node.parent) {
      const float other = luminanceOf(carried(children[i + 1]));
      const bool isOther = chance(node.corner, 2u * node.generation) * (left + other) >= left;
      const float all = left + other;
      if (isOther) {
        child = children[i + 1];
        left = other;
      }
      child.flux *= all / left;
      left = all;
      ++i;
    }
    if (left < least && child.generation > 1) {
      if (chance(node.corner, 2u * node.generation + 1) * least >= left) continue;
      child.flux *= least / left;
      child.gain *= least / left;
    }
    children[kept++] = child;
  }
  children.resize(kept);
}

}  // namespace nephroid
