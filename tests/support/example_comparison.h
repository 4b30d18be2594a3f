// A comparison without a renderer: a floor with a bright ring on it.
#pragma once

#include <cmath>
#include <random>

#include "report/comparison.h"

namespace nephroid {

struct ExampleImage {
  uint32_t width, height;
  double causticsScale = 1;  // of the ring
  double deviation = 0;      // of noise on the ring, over its values
};

inline Image exampleImage(const ExampleImage& example) {
  Image image{example.width, example.height, {}};
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 1);
  for (const char* name : {"R", "G", "B"}) {
    for (const char* layer : {"", "direct.", "caustics."}) image.channel(std::string(layer) + name);
    std::vector<float>& direct = image.channel(std::string("direct.") + name);
    std::vector<float>& caustics = image.channel(std::string("caustics.") + name);
    std::vector<float>& total = image.channel(name);
    for (std::size_t i = 0; i < total.size(); ++i) {
      const double x = (double(i % example.width) + 0.5) / example.width - 0.5;
      const double y = (double(i / example.width) + 0.5) / example.height - 0.5;
      const double ring = (std::hypot(x, y) - 0.25) / 0.06;
      const double tint = *name == 'R' ? 1 : *name == 'G' ? 0.8 : 0.5;
      direct[i] = float(0.15 + 0.1 * y);
      caustics[i] = float(tint * example.causticsScale * std::exp(-ring * ring) *
                          std::max(0.0, 1 + example.deviation * noise(random)));
      total[i] = direct[i] + caustics[i];
    }
  }
  return image;
}

inline void addVariance(Image& image, double deviation) {
  for (const char* name : {"R", "G", "B"}) {
    const std::vector<float> values = *image.find(std::string("caustics.") + name);
    for (const char* layer : {"variance.", "caustics.variance."}) {
      std::vector<float>& variance = image.channel(std::string(layer) + name);
      for (std::size_t i = 0; i < values.size(); ++i)
        variance[i] = float(deviation * deviation) * values[i] * values[i];
    }
  }
}

inline SideBySide exampleSide(uint32_t width, uint32_t height, const std::string& sensor) {
  constexpr double kDeviation = 0.02;
  SideBySide side;
  side.sensor = sensor;
  side.reference.image = exampleImage({width, height, 1, kDeviation});
  addVariance(side.reference.image, kDeviation);
  side.reference.passes = 64;
  side.reference.noise = kDeviation;
  side.reference.seconds = 83.5;
  for (const auto& [name, scale] : {std::pair("illumination-textures", 0.97), std::pair("none", 0.0)}) {
    TechniqueResult technique;
    technique.image = exampleImage({width, height, scale});
    technique.stats.technique = name;
    technique.stats.source = "table";
    technique.stats.device = "a device";
    technique.stats.frameMilliseconds = 98.25;
    technique.stats.prepareMilliseconds = 1250;
    technique.stats.memoryBytes = 64u << 20;
    side.techniques.push_back(std::move(technique));
  }
  if (sensor.empty()) side.seesReceiver.assign(std::size_t(width) * height, 1);
  return side;
}

inline Comparison exampleComparison() {
  Comparison comparison;
  comparison.program = "nephroid 1.2.3";
  comparison.scene = "ring </script>.toml";
  comparison.commandLine = "nephroid compare 'ring </script>.toml' -o report";
  comparison.device = "a device";
  comparison.paths = "all";
  comparison.techniquePaths = "transmission";
  comparison.spectrum = "continuous";
  comparison.photons = 1u << 20;
  comparison.leftOut = {{"", "The air", false}, {"none", "Caustics", true}};
  comparison.view = exampleSide(320, 240, "");
  comparison.sensors.push_back(exampleSide(64, 64, "the floor/1"));
  return comparison;
}

}  // namespace nephroid
