#include "reference/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/colorimetry.h"

namespace nephroid {
namespace {

constexpr uint32_t kSteps = 350;  // of the table, each a nanometer
static_assert(kShortestWavelength + kSteps == kLongestWavelength);
constexpr uint32_t kBandsOfPass = 16;

// Each channel's share of white light by wavelength, constant over each nanometer.
struct Table {
  std::array<vec3, kSteps> shares{};            // 1/nm; each channel sums to 1
  std::array<double, kSteps + 1> cumulative{};  // of the mean of the channels

  Table() {
    glm::dvec3 sum(0);
    for (uint32_t i = 0; i < kSteps; ++i) {
      shares[i] = glm::max(rec709FromXyz(colorMatching(kShortestWavelength + float(i) + 0.5f)), vec3(0));
      sum += glm::dvec3(shares[i]);
    }
    for (uint32_t i = 0; i < kSteps; ++i) {
      shares[i] = vec3(glm::dvec3(shares[i]) / sum);
      cumulative[i + 1] = cumulative[i] + density(i);
    }
  }
  double density(uint32_t i) const { return (double(shares[i].x) + shares[i].y + shares[i].z) / 3; }
};

const Table& table() {
  static const Table made;
  return made;
}

uint32_t stepOf(float wavelength) {
  return std::min(static_cast<uint32_t>(std::max(wavelength - kShortestWavelength, 0.0f)), kSteps - 1);
}

float inverseSquare(float wavelength) {
  return 1 / (wavelength * wavelength);
}

}  // namespace

float wavelengthDensity(float wavelength) {
  return static_cast<float>(table().density(stepOf(wavelength)));
}

vec3 wavelengthWeight(float wavelength) {
  return table().shares[stepOf(wavelength)] / wavelengthDensity(wavelength);
}

float sampleWavelength(float u) {
  const auto& cumulative = table().cumulative;
  const double wanted = u * cumulative.back();
  const auto above = std::upper_bound(cumulative.begin() + 1, cumulative.end() - 1, wanted);
  const double low = *(above - 1);
  const double within = (wanted - low) / std::max(*above - low, 1e-12);
  return kShortestWavelength + static_cast<float>(double(above - cumulative.begin() - 1) + within);
}

std::vector<Band> chooseBands(const Scene& scene, Spectrum spectrum, Random& random) {
  const bool disperses = std::ranges::any_of(scene.objects, [&](const Object& object) {
    const Material& material = scene.materialOf(object);
    return material.type == MaterialType::dielectric && material.isDispersive();
  });
  if (!disperses) return {Band{}};
  if (spectrum == Spectrum::channels)
    return {{0, 0, vec3(3, 0, 0)}, {0, 1, vec3(0, 3, 0)}, {0, 2, vec3(0, 0, 3)}};
  std::vector<Band> bands(kBandsOfPass);
  for (uint32_t i = 0; i < kBandsOfPass; ++i) {
    bands[i].wavelength = sampleWavelength((float(i) + random.uniform()) / float(kBandsOfPass));
    bands[i].weight = wavelengthWeight(bands[i].wavelength);
  }
  return bands;
}

float indexOfRefraction(const Material& material, const Band& band) {
  if (band.wavelength <= 0 || !material.isDispersive()) return material.ior[int(band.channel)];
  const float x = inverseSquare(band.wavelength);
  if (material.dispersion > 0) {
    const float d = inverseSquare(587.56f), f = inverseSquare(486.13f), c = inverseSquare(656.27f);
    const float spread = (material.ior.y - 1) * material.dispersion / 20;  // n_F - n_C
    return std::max(1.0f, material.ior.y + spread * (x - d) / (f - c));
  }
  const float red = inverseSquare(611), green = inverseSquare(549), blue = inverseSquare(464);
  const float index = x < green ? glm::mix(material.ior.x, material.ior.y, (x - red) / (green - red))
                                : glm::mix(material.ior.y, material.ior.z, (x - green) / (blue - green));
  return std::max(1.0f, index);
}

}  // namespace nephroid
