// Light that another program counted or evaluated: scenes/truth and scripts/count_truth.py.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "render/measure.h"
#include "scene/scene.h"

namespace nephroid {

struct CountedTruth {
  std::string name;  // of the scene's file, without its ending
  std::filesystem::path scene;
  std::vector<float> lux;  // green, by texel of the scene's first sensor, which met a caster, by all ways
  double spread = 0;       // RMS of the standard error of lux over its mean; 0: exact
};

// All of `folder`, by name. Throws InputError where a file is missing or wrong.
std::vector<CountedTruth> countedTruths(const std::filesystem::path& folder);

struct TruthErrors {
  double fluxRatio = 0;     // over the truth's
  double relativeRmse = 0;  // over the truth's mean; the truth's spread is part of it
  double withoutWorst = 0;  // the same without the hundredth of the texels that is worst
};

// Of the green light. `truth` is of as many texels, and not dark.
TruthErrors errorsAgainst(std::span<const float> truth, const SensorLayer& lux);

// Means of blocks of `side` x `side` texels; `width` texels in a row.
template <class Value>
std::vector<Value> meansOfBlocks(std::span<const Value> texels, uint32_t width, uint32_t side) {
  const std::size_t columns = width / side;
  std::vector<Value> means(texels.size() / side / side, Value(0));
  for (std::size_t i = 0; i < texels.size(); ++i)
    means[i / width / side * columns + i % width / side] += texels[i] / float(side * side);
  return means;
}

}  // namespace nephroid
