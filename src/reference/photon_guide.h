// Where photons are sent: more to where the picture's noise comes from.
#pragma once

#include <span>
#include <vector>

namespace nephroid {

// A density over the numbers that Lights::emit makes photons of, constant in each of some equal parts of
// [0, 1).
class PhotonGuide {
 public:
  PhotonGuide() = default;  // even

  // `squares`: of each part, the sum of the squares of what evenly spread photons added to the picture's
  // pixels. With a density that goes with its root the variances of the pixels have the least sum. Each part
  // gets some photons all the same, as some of the light may have been missed.
  explicit PhotonGuide(std::span<const double> squares);

  struct Sent {
    double choice = 0;  // in [0, 1)
    float weight = 1;   // 1 over the density
  };
  // `u` in [0, 1). Evenly spread numbers give photons that are evenly spread within each part.
  Sent at(double u) const;

 private:
  std::vector<double> cumulative_;  // the probability of each part and of those before it; empty: even
};

}  // namespace nephroid
