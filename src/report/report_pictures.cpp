#include "report/report_pictures.h"

#include <limits>

#include "render/picture.h"
#include "report/false_color.h"

namespace nephroid {
namespace {

constexpr double kRelativeBound = 0.25;    // where relative errors end in the deepest color
constexpr double kBrightQuantile = 0.995;  // of values, those above are a few texels of a focus

struct ShownLayer {
  const char* prefix;
  const char* name;
};
constexpr ShownLayer kAllLight{"", "All light"};
constexpr ShownLayer kCaustics{"caustics.", "Caustics alone"};

ByteImage mapOf(const std::vector<float>& values, const Image& size, const ColorScale& scale) {
  const double bound = scale.unit == "%" ? scale.bound / 100 : scale.bound;
  return scale.isSigned ? signedMap(values, size.width, size.height, bound)
                        : magnitudeMap(values, size.width, size.height, bound);
}

std::vector<ShownLayer> layersOf(const SideBySide& pair) {
  std::vector<ShownLayer> layers{kAllLight};
  bool hasCaustics = hasLayer(pair.reference.image, kCaustics.prefix);
  for (const TechniqueResult& technique : pair.techniques)
    hasCaustics = hasCaustics && hasLayer(technique.image, kCaustics.prefix);
  if (hasCaustics) layers.push_back(kCaustics);
  return layers;
}

PictureView cameraView(const SideBySide& pair, const ShownLayer& layer, const ToneMapping& toneMapping) {
  PictureView view{layer.name, std::nullopt, pictureOf(pair.reference.image, toneMapping, layer.prefix), {}};
  for (const TechniqueResult& technique : pair.techniques)
    view.techniques.push_back(pictureOf(technique.image, toneMapping, layer.prefix));
  return view;
}

PictureView sensorView(const SideBySide& pair, const ShownLayer& layer) {
  const std::vector<float> truth = channelMeans(pair.reference.image, layer.prefix);
  const ColorScale scale{false, endOfScale(quantile(truth, kBrightQuantile)), "lux"};
  PictureView view{layer.name, scale, mapOf(truth, pair.reference.image, scale), {}};
  for (const TechniqueResult& technique : pair.techniques)
    view.techniques.push_back(
        mapOf(channelMeans(technique.image, layer.prefix), pair.reference.image, scale));
  return view;
}

// One scale for all techniques, that ends with the errors of the best: what is not drawn at all says nothing
// about what is.
ColorScale absoluteScale(const SideBySide& pair, const ShownLayer& layer, const std::string& unit) {
  double least = std::numeric_limits<double>::infinity();
  for (const TechniqueResult& technique : pair.techniques) {
    const double most =
        quantile(absoluteErrors(pair.reference.image, technique.image, layer.prefix), kBrightQuantile);
    if (most > 0) least = std::min(least, most);
  }
  return {false, endOfScale(least < std::numeric_limits<double>::infinity() ? least : 0), unit};
}

std::string lowered(std::string name) {
  name[0] = char(std::tolower(static_cast<unsigned char>(name[0])));
  return name;
}

std::vector<ErrorMap> mapsOf(const SideBySide& pair, const TechniqueResult& technique, const Errors& errors,
                             const std::vector<ShownLayer>& layers) {
  const Image& reference = pair.reference.image;
  std::vector<ErrorMap> maps;
  if (errors.flip) {
    const ColorScale scale{false, 1, ""};
    maps.push_back({"LDR-FLIP", scale, mapOf(errors.flip->map, reference, scale)});
  }
  const ColorScale relative{true, 100 * kRelativeBound, "%"};
  for (const ShownLayer& layer : layers)
    maps.push_back({"Relative error, " + lowered(layer.name), relative,
                    mapOf(relativeErrors(reference, technique.image, layer.prefix), reference, relative)});
  const ShownLayer& last = layers.back();
  const ColorScale absolute = absoluteScale(pair, last, errors.flip ? "nit" : "lux");
  maps.push_back({"Absolute error, " + lowered(last.name), absolute,
                  mapOf(absoluteErrors(reference, technique.image, last.prefix), reference, absolute)});
  return maps;
}

}  // namespace

SidePictures picturesOf(const SideBySide& pair, const std::vector<Errors>& errors,
                        const ToneMapping& toneMapping) {
  const std::vector<ShownLayer> layers = layersOf(pair);
  SidePictures pictures;
  for (const ShownLayer& layer : layers)
    pictures.views.push_back(pair.sensor.empty() ? cameraView(pair, layer, toneMapping)
                                                 : sensorView(pair, layer));
  for (std::size_t i = 0; i < pair.techniques.size(); ++i)
    pictures.maps.push_back(mapsOf(pair, pair.techniques[i], errors[i], layers));
  return pictures;
}

}  // namespace nephroid
