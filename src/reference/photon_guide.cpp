#include "reference/photon_guide.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid {
namespace {

constexpr double kEven = 0.25;   // of the photons
constexpr double kHighest = 16;  // density, where a few photons by chance were worth very much

}  // namespace

PhotonGuide::PhotonGuide(std::span<const double> squares) {
  std::vector<double> worths;
  for (const double square : squares) worths.push_back(std::sqrt(square));
  const double mean = std::accumulate(worths.begin(), worths.end(), 0.0) / double(worths.size());
  if (!(mean > 0)) return;
  for (double& worth : worths) worth = std::min(worth, kHighest * mean);
  const double sum = std::accumulate(worths.begin(), worths.end(), 0.0);
  double before = 0;
  for (const double worth : worths)
    cumulative_.push_back(before += kEven / double(worths.size()) + (1 - kEven) * worth / sum);
  for (double& part : cumulative_) part /= before;
}

PhotonGuide::Sent PhotonGuide::at(double u) const {
  if (cumulative_.empty()) return {u, 1};
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, u);
  const double before = found == cumulative_.begin() ? 0 : *(found - 1);
  const double probability = *found - before;
  const double within = std::clamp((u - before) / probability, 0.0, 1 - 0x1p-32);
  const auto parts = double(cumulative_.size());
  return {(double(found - cumulative_.begin()) + within) / parts, float(1 / (probability * parts))};
}

}  // namespace nephroid
