#include "water/ocean.h"

#include <fftw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <mutex>
#include <numbers>
#include <span>

#include "core/hash.h"
#include "core/random.h"
#include "core/turn.h"

namespace nephroid {
namespace {

using Complex = std::complex<double>;
using glm::dvec2;

constexpr double kGravity = 9.81;  // m/s2

// m3/rad: the variance of height over wave numbers, whatever their direction.
double densityOverNumbers(const OceanSpectrum& ocean, double k) {
  const double wind = std::max(double(glm::length(ocean.wind)), 1e-6);
  if (ocean.shape == SpectrumShape::phillips) {
    constexpr double kPhillips = 0.0081;
    const double longest = wind * wind / kGravity;
    return 0.5 * kPhillips / (k * k * k) * std::exp(-1 / (k * longest * k * longest));
  }
  constexpr double kPeakedness = 3.3;
  const double fetch = double(ocean.fetch), omega = std::sqrt(kGravity * k);
  const double alpha = 0.076 * std::pow(wind * wind / (fetch * kGravity), 0.22);
  const double peak = 22 * std::cbrt(kGravity * kGravity / (wind * fetch));
  const double width = omega <= peak ? 0.07 : 0.09;
  const double away = (omega - peak) / (width * peak);
  const double overFrequencies = alpha * kGravity * kGravity / std::pow(omega, 5) *
                                 std::exp(-1.25 * std::pow(peak / omega, 4)) *
                                 std::pow(kPeakedness, std::exp(-0.5 * away * away));
  return overFrequencies * 0.5 * kGravity / omega;  // d omega / dk
}

// The waves that the water's grid holds: whole numbers of them between its sides.
struct Waves {
  uvec2 count;  // cells of the grid
  dvec2 size;   // m

  explicit Waves(const Water& water) : count(water.grid - 1u), size(water.size) {}
  std::size_t all() const { return std::size_t{count.x} * count.y; }
  dvec2 vectorOf(uint32_t x, uint32_t z) const {
    const auto number = [](uint32_t place, uint32_t of) {
      return double(place) - (2 * place >= of + (of % 2) ? double(of) : 0.0);
    };
    return kTurn * dvec2(number(x, count.x), number(z, count.y)) / size;
  }
  // Waves of half the grid's frequency have no direction there.
  bool isDirected(uint32_t x, uint32_t z) const {
    return (x > 0 || z > 0) && 2 * x != count.x && 2 * z != count.y;
  }
  double varianceAt(const OceanSpectrum& ocean, uint32_t x, uint32_t z) const {
    if (!isDirected(x, z)) return 0;
    return spectralDensity(ocean, vectorOf(x, z)) * kTurn * kTurn / (size.x * size.y);
  }
};

double varianceOf(const Waves& waves, const OceanSpectrum& ocean) {
  double sum = 0;
  for (uint32_t z = 0; z < waves.count.y; ++z)
    for (uint32_t x = 0; x < waves.count.x; ++x) sum += waves.varianceAt(ocean, x, z);
  return sum;
}

double scaleOf(const Waves& waves, const OceanSpectrum& ocean) {
  if (ocean.significantHeight <= 0) return 1;
  const double height = 4 * std::sqrt(varianceOf(waves, ocean));
  return height > 0 ? double(ocean.significantHeight) / height : 0;
}

// Two numbers of mean 0 and variance 1 each (Box and Muller).
Complex normalPair(Random& random) {
  const double radius = std::sqrt(-2 * std::log(1 - double(random.uniform())));
  return std::polar(radius, kTurn * double(random.uniform()));
}

// What each wave vector's wave has at time 0, going the vector's way. Each has random numbers of its own, so
// that a finer grid adds waves to the same sea.
std::vector<Complex> amplitudesAtStart(const Waves& waves, const OceanSpectrum& ocean) {
  std::vector<Complex> amplitudes(waves.all());
  const double scale = scaleOf(waves, ocean);
  for (uint32_t z = 0; z < waves.count.y; ++z)
    for (uint32_t x = 0; x < waves.count.x; ++x) {
      const dvec2 turns = glm::round(waves.vectorOf(x, z) * waves.size / kTurn);
      const std::array<int64_t, 3> own{int64_t{ocean.seed}, int64_t(turns.x), int64_t(turns.y)};
      Random random(hashBytes(std::as_bytes(std::span(own))));
      amplitudes[std::size_t{z} * waves.count.x + x] =
          normalPair(random) * (0.5 * scale * std::sqrt(waves.varianceAt(ocean, x, z)));
    }
  return amplitudes;
}

// In place: values over the grid, from those over wave vectors.
void transform(std::vector<Complex>& values, uvec2 count) {
  static std::mutex planning;  // FFTW plans one at a time
  auto* data = reinterpret_cast<fftw_complex*>(values.data());
  fftw_plan plan;
  {
    const std::lock_guard lock(planning);
    plan = fftw_plan_dft_2d(int(count.y), int(count.x), data, data, FFTW_BACKWARD, FFTW_ESTIMATE);
  }
  fftw_execute(plan);
  const std::lock_guard lock(planning);
  fftw_destroy_plan(plan);
}

}  // namespace

double spectralDensity(const OceanSpectrum& ocean, dvec2 waveVector) {
  const double k = glm::length(waveVector);
  if (k == 0) return 0;
  const dvec2 wind = dvec2(ocean.wind) / std::max(double(glm::length(ocean.wind)), 1e-6);
  const double cosine = std::max(glm::dot(waveVector, wind) / k, 0.0);
  return densityOverNumbers(ocean, k) / k * (2 / std::numbers::pi) * cosine * cosine;
}

double waveFrequency(double waveNumber, double depth) {
  return std::sqrt(kGravity * waveNumber * (std::isinf(depth) ? 1 : std::tanh(waveNumber * depth)));
}

double oceanVariance(const Water& water) {
  const Waves waves(water);
  const double scale = scaleOf(waves, *water.ocean);
  return scale * scale * varianceOf(waves, *water.ocean);
}

OceanSurface oceanSurface(const Water& water, double time) {
  const OceanSpectrum& ocean = *water.ocean;
  const Waves waves(water);
  const uvec2 count = waves.count;
  const std::vector<Complex> start = amplitudesAtStart(waves, ocean);
  // Heights; slopes as x + i z, and offsets likewise: each is real.
  std::vector<Complex> heights(waves.all()), slopes(waves.all()), offsets(waves.all());
  for (uint32_t z = 0; z < count.y; ++z)
    for (uint32_t x = 0; x < count.x; ++x) {
      const std::size_t at = std::size_t{z} * count.x + x,
                        opposite = std::size_t{(count.y - z) % count.y} * count.x + (count.x - x) % count.x;
      const dvec2 k = waves.vectorOf(x, z);
      const double length = glm::length(k);
      const Complex turned = std::polar(1.0, -waveFrequency(length, double(ocean.depth)) * time);
      // The wave itself and, since the surface is real, the other half of the opposite one.
      const Complex wave = start[at] * turned + std::conj(start[opposite] * turned);
      const Complex along(k.x, k.y);
      heights[at] = wave;
      slopes[at] = wave * Complex(0, 1) * along;
      if (length > 0) offsets[at] = wave * Complex(0, double(ocean.choppiness)) * along / length;
    }
  transform(heights, count);
  transform(slopes, count);
  transform(offsets, count);

  OceanSurface surface;
  const auto pair = [](Complex value) { return dvec2(value.real(), value.imag()); };
  for (uint32_t z = 0; z <= count.y; ++z)
    for (uint32_t x = 0; x <= count.x; ++x) {
      const std::size_t at = std::size_t{z % count.y} * count.x + x % count.x;
      surface.heights.push_back(heights[at].real());
      surface.slopes.push_back(pair(slopes[at]));
      surface.offsets.push_back(pair(offsets[at]));
    }
  return surface;
}

}  // namespace nephroid
