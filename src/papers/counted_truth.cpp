#include "papers/counted_truth.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/error.h"
#include "core/image_io.h"

namespace nephroid {

std::vector<CountedTruth> countedTruths(const std::filesystem::path& folder) {
  const std::filesystem::path list = folder / "answers.json";
  std::ifstream file(list);
  if (!file) throw InputError("cannot read '" + list.string() + "': no such file");
  std::vector<CountedTruth> truths;
  try {
    for (const nlohmann::json& answer : nlohmann::json::parse(file)) {
      CountedTruth truth;
      truth.name = answer.at("scene");
      truth.spread = answer.at("spread");
      truth.scene = folder / (truth.name + ".toml");
      truths.push_back(std::move(truth));
    }
  } catch (const nlohmann::json::exception& wrong) {
    throw InputError("cannot read '" + list.string() + "': " + wrong.what());
  }
  for (CountedTruth& truth : truths) {
    const std::filesystem::path counts = folder / (truth.name + ".pfm");
    const Image image = readPfm(counts);
    const std::vector<float>* lux = image.find("Y");
    if (!lux) throw InputError("'" + counts.string() + "' has colors; counts have one channel");
    truth.lux = *lux;
  }
  return truths;
}

TruthErrors errorsAgainst(std::span<const float> truth, const SensorLayer& lux) {
  double sum = 0, truthSum = 0;
  std::vector<double> squares;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    sum += double(lux[i].y);
    truthSum += double(truth[i]);
    squares.push_back(std::pow(double(lux[i].y) - double(truth[i]), 2));
  }
  const auto relativeRmse = [&] {
    const double all = std::accumulate(squares.begin(), squares.end(), 0.0);
    return std::sqrt(all / double(squares.size())) / (truthSum / double(truth.size()));
  };
  TruthErrors errors;
  errors.fluxRatio = sum / truthSum;
  errors.relativeRmse = relativeRmse();
  std::ranges::sort(squares);
  squares.resize(squares.size() - squares.size() / 100);
  errors.withoutWorst = relativeRmse();
  return errors;
}

}  // namespace nephroid
