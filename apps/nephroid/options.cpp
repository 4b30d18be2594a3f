#include <algorithm>
#include <cmath>
#include <sstream>

#include "command.h"
#include "core/atomic_file.h"
#include "core/error.h"
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
  for (const TechniqueEntry& entry : techniques()) names.emplace_back(entry.name);
  names.emplace_back(kReferenceName);
  return names;
}

std::vector<ImageAttribute> imageAttributes(const TechniqueSettings& settings, const std::string& unit) {
  return {{"software", std::string("nephroid ") + NEPHROID_VERSION},
          {"technique", settings.technique},
          {"source", std::string(nameOf(settings.source))},
          {"paths", std::string(nameOf(settings.paths))},
          {"interpolation", std::string(nameOf(settings.interpolation))},
          {"unit", unit}};
}

void addScene(CLI::App& command, fs::path& scene) {
  command.add_option("SCENE", scene, "The scene: a .toml, .gltf or .glb file")->required()->type_name("");
}

void addOutput(CLI::App& command, fs::path& output, const std::string& help) {
  command.add_option("-o,--output", output, help)->required()->type_name("FILE");
}

void addTime(CLI::App& command, double& time) {
  command.add_option("--time", time, "The time that what moves by itself is shown at, in seconds")
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

void addDevice(CLI::App& command, std::string& device) {
  command
      .add_option("--device", device,
                  "The Vulkan device: its number in `nephroid info`, or a part of its name. Left out: a GPU "
                  "where there is one, Mesa's software device where there is none")
      ->type_name("DEVICE");
}

void addQuiet(CLI::App& command, bool& isQuiet) {
  command.add_flag("--quiet", isQuiet, "No progress bars");
}

void addRepeat(CLI::App& command, uint32_t& repeat) {
  command
      .add_option(
          "--repeat", repeat,
          "Do the frame this many times, each time all that a moved light would change; the time told "
          "is their median")
      ->check(CLI::Range(1u, 1000000u))
      ->type_name("N")
      ->capture_default_str();
}

void addStats(CLI::App& command, fs::path& stats) {
  command
      .add_option(
          "--stats", stats,
          "Where to write what the run took: device, technique, source, prepare_ms, frame_ms, passes, "
          "counts, memory_bytes")
      ->type_name("FILE.json");
}

void addField(CLI::App& command, const SettingField& field, TechniqueSettings& settings, bool isSensorKnown) {
  CLI::Option* option =
      command.add_option(std::string("--") + field.flag, settings.*field.member, field.help);
  const std::string range = std::to_string(field.minimum) + " to " + std::to_string(field.maximum);
  const bool hasZeroWord = isSensorKnown && field.zeroWord;
  const std::string words = hasZeroWord ? range + ", or " + field.zeroWord : range;
  const auto check = [=](std::string& text) -> std::string {
    if (hasZeroWord && text == field.zeroWord) {
      text = "0";
      return {};
    }
    uint32_t number = 0;
    const bool isNumber = CLI::detail::lexical_cast(text, number);
    if (isNumber && number >= field.minimum && number <= field.maximum) return {};
    return "'" + text + "' is not a whole number from " + words;
  };
  option->transform(CLI::Validator(check, "(" + words + ")"))
      ->type_name("N")
      ->capture_default_str()
      ->group("Technique");
}

void addPart(CLI::App& command, const PartField& field, TechniqueSettings& settings) {
  const auto check = [](const std::string& text) -> std::string {
    float part = 0;
    if (CLI::detail::lexical_cast(text, part) && part >= 0 && part <= 1) return {};
    return "'" + text + "' is not a number from 0 to 1";
  };
  command.add_option(std::string("--") + field.flag, settings.*field.member, field.help)
      ->check(CLI::Validator(check, "(0 to 1)"))
      ->type_name("PART")
      ->capture_default_str()
      ->group("Technique");
}

void addTechnique(CLI::App& command, TechniqueSettings& settings, bool isSensorKnown) {
  const std::vector<std::string> names = techniqueList();
  command.add_option("--technique", settings.technique, "How caustics are made: " + joined(names))
      ->check(oneOf(names))
      ->type_name("NAME")
      ->capture_default_str()
      ->group("Technique");
  addTechniqueSettings(command, settings, isSensorKnown);
}

void addChoice(CLI::App& command, const ChoiceField& field, TechniqueSettings& settings) {
  const std::vector<std::string> names(field.names.begin(), field.names.end());
  command
      .add_option_function<std::string>(
          std::string("--") + field.flag,
          [&settings, &field, names](const std::string& value) {
            field.set(settings, uint32_t(std::ranges::find(names, value) - names.begin()));
          },
          field.help)
      ->check(oneOf(names))
      ->type_name(joined(names, "|"))
      ->default_str(field.names[field.get(settings)])
      ->group("Technique");
}

void addTechniqueSettings(CLI::App& command, TechniqueSettings& settings, bool isSensorKnown) {
  for (const ChoiceField& field : choiceFields()) addChoice(command, field, settings);
  command
      .add_option(
          "--baked", settings.baked,
          "The light transport tables or irradiance volumes that `nephroid bake` wrote for this scene")
      ->type_name("FILE")
      ->group("Technique");
  for (const SettingField& field : settingFields()) addField(command, field, settings, isSensorKnown);
  for (const PartField& field : partFields()) addPart(command, field, settings);
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

void writeStats(const fs::path& file, const Stats& stats) {
  if (!file.empty()) writeFileAtomically(file, statsJson(stats));
}

}  // namespace nephroid
