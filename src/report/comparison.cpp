#include "report/comparison.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "render/picture.h"
#include "report/flip.h"

namespace nephroid {
namespace {

struct LayerName {
  const char* prefix;
  const char* name;
};
constexpr LayerName kLayers[] = {{"", "total"}, {"direct.", "direct"}, {"caustics.", "caustics"}};

void checkSizes(const Image& reference, const Image& image, const std::string& technique) {
  if (reference.width == image.width && reference.height == image.height) return;
  const auto size = [](const Image& of) {
    return std::to_string(of.width) + "x" + std::to_string(of.height);
  };
  throw InputError("the image of '" + technique + "' is " + size(image) + " pixels, that of the reference " +
                   size(reference) + "; they have to be of one size");
}

FlipResult flipOf(const Image& reference, const Image& image, const ToneMapping& toneMapping) {
  FlipResult flip;
  flip.map = ldrFlip(pictureOf(reference, toneMapping, "", Rounding::nearest),
                     pictureOf(image, toneMapping, "", Rounding::nearest));
  flip.mean = std::accumulate(flip.map.begin(), flip.map.end(), 0.0) / double(flip.map.size());
  flip.maximum = double(*std::max_element(flip.map.begin(), flip.map.end()));
  return flip;
}

Errors errorsOf(const SideBySide& pair, const TechniqueResult& technique, const ToneMapping& toneMapping) {
  const Image& reference = pair.reference.image;
  checkSizes(reference, technique.image, technique.stats.technique);
  Errors errors;
  for (const auto& [prefix, name] : kLayers)
    if (hasLayer(reference, prefix) && hasLayer(technique.image, prefix))
      errors.layers.push_back({name, layerErrors(reference, technique.image, prefix)});
  if (!pair.seesReceiver.empty() && hasLayer(reference, "caustics.") &&
      hasLayer(technique.image, "caustics."))
    errors.layers.push_back(
        {"caustics seen directly", layerErrors(pixelsOf(reference, pair.seesReceiver),
                                               pixelsOf(technique.image, pair.seesReceiver), "caustics.")});
  if (pair.sensor.empty()) errors.flip = flipOf(reference, technique.image, toneMapping);
  return errors;
}

}  // namespace

std::vector<Errors> errorsOf(const SideBySide& pair, const ToneMapping& toneMapping) {
  std::vector<Errors> all;
  for (const TechniqueResult& technique : pair.techniques)
    all.push_back(errorsOf(pair, technique, toneMapping));
  return all;
}

std::string whatDiffers(const Comparison& comparison) {
  if (comparison.paths == "transmission")
    return "Reference and techniques follow the same light: refraction alone (--paths transmission). On "
           "sensors and on "
           "surfaces that are seen directly, what differs is numerical error. How glass and mirrors look "
           "themselves is "
           "the frame's own approximation, and stays part of the error.";
  const std::string techniques = comparison.techniquePaths == "transmission"
                                     ? "the techniques refraction alone, as their papers do"
                                     : "the techniques most of these ways (--paths all)";
  return "The reference follows light every way, by refraction and by reflection inside and outside; " +
         techniques +
         ". What differs is the error of a technique's model, listed below, and its numerical error; with "
         "--paths "
         "transmission the latter stands alone.";
}

}  // namespace nephroid
