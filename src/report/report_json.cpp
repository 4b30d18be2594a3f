#include "report/report_json.h"

#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/settings.h"
#include "scene/tone_curve.h"

namespace nephroid {
namespace {

using Json = nlohmann::ordered_json;

// JSON has no infinities and no NaN.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json number(const std::optional<double>& value) {
  return value ? number(*value) : Json();
}

Json layersJson(const Errors& errors) {
  Json layers = Json::object();
  for (const auto& [name, layer] : errors.layers)
    layers[name] = {{"reference_mean", number(layer.referenceMean)},
                    {"flux_ratio", number(layer.fluxRatio)},
                    {"relative_rmse", number(layer.relativeRmse)},
                    {"noise_floor", number(layer.noiseFloor)},
                    {"mape", number(layer.mape)},
                    {"counted_fraction", number(layer.countedFraction)}};
  // Photons on a sensor are counted without bias; a picture's are gathered by a kernel, which no variance
  // tells.
  if (!errors.flip)
    for (const auto& [name, layer] : errors.layers) layers[name]["z_score_rms"] = number(layer.zScoreRms);
  return layers;
}

Json techniqueJson(const TechniqueResult& technique, const Errors& errors) {
  Json json{{"name", technique.stats.technique},
            {"source", technique.stats.source},
            {"device", technique.stats.device},
            {"frame_ms", number(technique.stats.frameMilliseconds)},
            {"prepare_ms", number(technique.stats.prepareMilliseconds)},
            {"memory_bytes", technique.stats.memoryBytes}};
  if (errors.flip)
    json["ldr_flip"] = {{"mean", number(errors.flip->mean)}, {"maximum", number(errors.flip->maximum)}};
  json["layers"] = layersJson(errors);
  return json;
}

Json sideJson(const SideBySide& side, const std::vector<Errors>& errors, uint32_t photons) {
  Json json;
  if (!side.sensor.empty()) json["sensor"] = side.sensor;
  json["size"] = {side.reference.image.width, side.reference.image.height};
  json["unit"] = side.sensor.empty() ? "nit" : "lux";
  json["reference"] = {{"passes", side.reference.passes},
                       {"photons_a_pass", photons},
                       {"noise", number(side.reference.noise)},
                       {"seconds", number(side.reference.seconds)}};
  json["techniques"] = Json::array();
  for (std::size_t i = 0; i < side.techniques.size(); ++i)
    json["techniques"].push_back(techniqueJson(side.techniques[i], errors[i]));
  return json;
}

Json unitsJson() {
  return {{"reference_mean", "nit for the view, lux for sensors; over pixels and channels"},
          {"flux_ratio", "sum of the technique over sum of the reference"},
          {"relative_rmse", "root mean square difference over the reference's mean"},
          {"noise_floor", "the relative_rmse that the reference's own variance explains"},
          {"mape", "mean |difference| over reference, of pixels above the reference's standard error"},
          {"counted_fraction", "pixels that count for mape, of all"},
          {"z_score_rms", "root mean square of difference over the reference's standard error"},
          {"ldr_flip", "0 to 1, of tone-mapped sRGB pictures at 67 pixels a degree"},
          {"noise", "the reference's relative standard error"},
          {"frame_ms", "ms, median; all that a moved light would change"},
          {"prepare_ms", "ms, once"},
          {"memory_bytes", "bytes on the device"},
          {"seconds", "s that all passes of the reference took"},
          {"time_s", "s, of what moves by itself"}};
}

}  // namespace

ComparisonErrors errorsOf(const Comparison& comparison) {
  ComparisonErrors errors;
  errors.view = errorsOf(comparison.view, comparison.toneMapping);
  for (const SideBySide& sensor : comparison.sensors)
    errors.sensors.push_back(errorsOf(sensor, comparison.toneMapping));
  return errors;
}

std::string reportFileName(const Comparison& comparison, const std::string& what,
                           std::optional<std::size_t> sensor, const std::string& extension) {
  std::string name;
  if (sensor) {
    name = "sensor" + std::to_string(*sensor + 1) + "-";
    for (const char c : comparison.sensors[*sensor].sensor)
      name += std::isalnum(static_cast<unsigned char>(c)) || c == '_' ? c : '-';
    name += ".";
  }
  return name + what + extension;
}

std::string reportJson(const Comparison& comparison, const ComparisonErrors& errors,
                       const std::vector<std::string>& files) {
  Json json{{"format", kReportFormat},
            {"program", comparison.program},
            {"scene", comparison.scene},
            {"command", comparison.commandLine},
            {"device", comparison.device},
            {"time_s", number(comparison.time)},
            {"exposure", number(double(comparison.toneMapping.exposure))},
            {"tone", nameOf(ToneCurve(comparison.toneMapping.curve))},
            {"paths", comparison.paths},
            {"technique_paths", comparison.techniquePaths},
            {"spectrum", comparison.spectrum},
            {"what_differs", whatDiffers(comparison)},
            {"units", unitsJson()}};
  json["view"] = sideJson(comparison.view, errors.view, comparison.photons);
  json["sensors"] = Json::array();
  for (std::size_t i = 0; i < comparison.sensors.size(); ++i)
    json["sensors"].push_back(sideJson(comparison.sensors[i], errors.sensors[i], comparison.photons));
  json["left_out"] = Json::array();
  for (const LeftOut& omission : comparison.leftOut)
    json["left_out"].push_back({{"technique", omission.technique},
                                {"what", omission.what},
                                {"concerns_scene", omission.concernsScene}});
  json["files"] = files;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace nephroid
