#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

#include "command.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "report/missing_light.h"
#include "techniques/registry.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::string joined(const std::vector<std::string>& names, const std::string& between) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : between) + name;
  return text;
}

std::function<std::string(const std::string&)> oneOf(std::vector<std::string> names) {
  return [names = std::move(names)](const std::string& value) -> std::string {
    if (std::find(names.begin(), names.end(), value) != names.end()) return {};
    const std::string nearest = nearestName(value, names);
    return "there is no '" + value + "' in this version; " +
           (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") + "There are: " + joined(names);
  };
}

std::vector<std::string> techniqueList() {
  std::vector<std::string> names;
  for (const TechniqueInfo* info : techniques()) names.emplace_back(info->name);
  names.emplace_back(kReferenceName);
  return names;
}

bool isReference(const PictureSettings& settings) {
  return settings.technique.technique == kReferenceName;
}

std::vector<ImageAttribute> imageAttributes(const PictureSettings& settings, const std::string& unit) {
  Stats described;
  describeSettings(settings, described);
  std::vector<ImageAttribute> attributes{{"software", std::string("nephroid ") + NEPHROID_VERSION},
                                         {"technique", described.technique},
                                         {"unit", unit}};
  for (const auto& [flag, value] : described.settings) attributes.push_back({flag, value});
  return attributes;
}

void addScene(CLI::App& command, fs::path& scene) {
  command.add_option("SCENE", scene, "The scene: a .toml, .gltf or .glb file")->required()->type_name("");
}

void addOutput(CLI::App& command, fs::path& output, const std::string& help) {
  command.add_option("-o,--output", output, help)->required()->type_name("FILE");
}

void addTime(CLI::App& command, double& time) {
  command.add_option("--time", time, "The time of the scene in seconds, for everything that moves by itself")
      ->check([](const std::string& text) {
        double seconds = 0;
        const bool isNumber = CLI::detail::lexical_cast(text, seconds) && std::isfinite(seconds);
        return isNumber ? std::string() : "'" + text + "' is not a number of seconds";
      })
      ->type_name("SECONDS")
      ->capture_default_str();
}

std::optional<uvec2> pairOf(const std::string& text, char separator) {
  std::istringstream stream(text);
  uvec2 pair;
  char between = 0;
  if (text.find('-') != std::string::npos || !(stream >> pair.x >> between >> pair.y) ||
      between != separator || stream.peek() != EOF)
    return std::nullopt;
  return pair;
}

void addSize(CLI::App& command, uvec2& size) {
  constexpr uint32_t kMaximum = 16384;
  command
      .add_option_function<std::string>(
          "--size",
          [&size](const std::string& text) {
            const std::optional<uvec2> pair = pairOf(text, 'x');
            if (!pair || std::min(pair->x, pair->y) < 1 || std::max(pair->x, pair->y) > kMaximum)
              throw CLI::ValidationError("--size", "'" + text +
                                                       "' is not WIDTHxHEIGHT, such as 640x480, each 1 to " +
                                                       std::to_string(kMaximum));
            size = *pair;
          },
          "The size of the picture in pixels")
      ->type_name("WxH")
      ->default_str(std::to_string(size.x) + "x" + std::to_string(size.y));
}

void addTone(CLI::App& command, ToneChoice& choice) {
  command
      .add_option_function<std::string>(
          "--exposure",
          [&choice](const std::string& text) {
            double number = 0;
            const bool isAuto = text == kAutoExposure;
            const bool isNumber = !isAuto && CLI::detail::lexical_cast(text, number) &&
                                  number >= kLeastExposure && number <= kMostExposure;
            if (!isAuto && !isNumber)
              throw CLI::ValidationError("--exposure", "'" + text + "' is neither " + kAutoExposure +
                                                           " nor a number from 1e-12 to 1e12");
            choice.isExposureChosen = true;
            choice.exposure = isAuto ? std::nullopt : std::optional(float(number));
          },
          "What luminance (nit) is multiplied by before the tone curve, or auto: metered on the picture, of "
          "--frames on the first one. Without it: as the scene says")
      ->type_name("N|auto");
  constexpr const auto& curves = kToneCurveNames;
  const std::vector<std::string> names(curves.begin(), curves.end());
  command
      .add_option_function<std::string>(
          "--tone",
          [&choice, names](const std::string& name) {
            choice.tone = ToneCurve(std::ranges::find(names, name) - names.begin());
          },
          "The tone curve of pictures: " + joined(names) + ". Without it: as the scene says")
      ->check(oneOf(names))
      ->type_name("NAME");
}

void addDevice(CLI::App& command, std::string& device) {
  command
      .add_option("--device", device,
                  "The Vulkan device: its number in `nephroid info`, or a part of its name. Without it: a "
                  "GPU if there is one, otherwise Mesa's software device")
      ->type_name("DEVICE");
}

void addQuiet(CLI::App& command, bool& isQuiet) {
  command.add_flag("--quiet", isQuiet, "No progress bars");
}

void addRepeat(CLI::App& command, uint32_t& repeat) {
  command
      .add_option("--repeat", repeat,
                  "Draw the frame this many times, each time with all work that a moved light needs, and "
                  "report the median time; with one sample of each pixel where --samples is not given")
      ->check(CLI::Range(1u, 1000000u))
      ->type_name("N")
      ->capture_default_str();
}

void addStats(CLI::App& command, fs::path& stats) {
  command
      .add_option(
          "--stats", stats,
          "Where to write the figures of the run: device, technique, source, error, left_out, exposure, "
          "shortfall, notes, prepare_ms, frame_ms, passes, counts, memory_bytes")
      ->type_name("FILE.json");
}

void addSetting(CLI::App& command, const Setting& setting, void* owner, const std::string& group,
                bool takesWord) {
  const std::string flag = std::string("--") + setting.flag;
  const bool isChoice = setting.kind == SettingKind::choice;
  const bool hasWord = takesWord && setting.wordForZero;
  const std::string range = rangeOf(setting) + (hasWord ? std::string(", or ") + setting.wordForZero : "");
  CLI::Option* option = command.add_option_function<std::string>(
      flag,
      [=](const std::string& text) {
        const std::string wrong = setFromText(setting, owner, text, takesWord);
        if (!wrong.empty()) throw CLI::ValidationError(flag, wrong);
      },
      isChoice ? setting.help : setting.help + (" (" + range + ")"));
  option->type_name(isChoice ? range : "N")->group(group);
  if (hasDefault(setting, owner)) option->default_str(textOf(setting, owner));
}

void addSettings(CLI::App& command, std::span<const SettingsView> views, bool takesWord) {
  for (const SettingsView& view : views)
    for (const Setting& setting : view.settings)
      addSetting(command, setting, view.values, view.owner, takesWord);
}

namespace {

void addTechniqueName(CLI::App& command, TechniqueSettings& settings) {
  std::vector<std::string> names = techniqueList();
  names.emplace_back(kAutomaticName);
  command
      .add_option_function<std::string>(
          "--technique",
          [&settings](const std::string& name) {
            settings.technique = name == kAutomaticName ? defaultTechnique() : name;
          },
          "How caustics are made: " + joined(names) + "; `nephroid help NAME` tells more about one")
      ->check(oneOf(names))
      ->type_name("NAME")
      ->default_str(settings.technique);
}

void addBaked(CLI::App& command, TechniqueSettings& settings) {
  command
      .add_option("--baked", settings.baked,
                  "The file that `nephroid bake` wrote for this scene and technique: light transport tables, "
                  "or irradiance volumes")
      ->type_name("FILE");
}

}  // namespace

void addTechnique(CLI::App& command, PictureSettings& settings) {
  addTechniqueName(command, settings.technique);
  addPictureSettings(command, settings);
}

void addTechniqueOfSensor(CLI::App& command, PictureSettings& settings) {
  addTechniqueName(command, settings.technique);
  addBaked(command, settings.technique);
  addSettings(command, allSettings(settings.technique), true);
}

void addPictureSettings(CLI::App& command, PictureSettings& settings) {
  addBaked(command, settings.technique);
  addSettings(command, allSettings(settings));
}

void checkOutput(const fs::path& file, const fs::path& scene, std::initializer_list<const char*> extensions) {
  const std::string extension = file.extension().string();
  std::string allowed;
  for (const char* each : extensions) {
    if (extension == each) allowed.clear();
    if (extension == each) break;
    allowed += (allowed.empty() ? "" : " or ") + std::string(each);
  }
  if (!allowed.empty())
    throw InputError("cannot write '" + file.string() + "': its name must end in " + allowed);
  std::error_code ignored;
  if (fs::equivalent(file, scene, ignored))
    throw InputError("'" + file.string() + "' is the scene itself; name another file to write");
  checkWritable(file);
}

void addToneAttributes(const ToneMapping& toneMapping, std::vector<ImageAttribute>& attributes) {
  attributes.push_back({"exposure", toneMapping.exposure});
  attributes.push_back({"tone", std::string(nameOf(ToneCurve(toneMapping.curve)))});
}

void warnOf(const Scene& scene, Stats& stats) {
  const std::size_t told = stats.warnings.size();
  for (const std::string& line : loadWarnings(scene)) addLine(stats.warnings, line);
  for (std::size_t i = told; i < stats.warnings.size(); ++i)
    std::cerr << "nephroid: warning: " << stats.warnings[i] << '\n';
}

void reportStats(const fs::path& file, const Stats& stats) {
  for (const std::string& note : stats.notes) std::cerr << "nephroid: note: " << note << '\n';
  if (!stats.shortfall.empty()) std::cerr << "nephroid: note: " << stats.shortfall << '\n';
  if (!file.empty()) writeFileAtomically(file, statsJson(stats));
}

}  // namespace nephroid
