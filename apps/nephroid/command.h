// A command of the program: its options, then what it does with them.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "core/image_io.h"
#include "core/stats.h"
#include "core/stopwatch.h"
#include "render/settings.h"

namespace nephroid {

// `run` is called after the whole command line is understood.
struct Command {
  const CLI::App* app;
  std::function<void()> run;
};

// Each declares its options on a subcommand of `program`.
Command addRender(CLI::App& program);
Command addMeasure(CLI::App& program);
Command addBake(CLI::App& program);
Command addCompare(CLI::App& program);
Command addBench(CLI::App& program);
Command addInfo(CLI::App& program);
Command addHelp(CLI::App& program);
Command addView(CLI::App& program);

// What most commands share.
struct CommonOptions {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::filesystem::path stats;  // empty: none
  std::string device;           // empty: the best there is
  double time = 0;              // s
  uint32_t repeat = 1;
  bool isQuiet = false;
};

void addScene(CLI::App& command, std::filesystem::path& scene);
void addOutput(CLI::App& command, std::filesystem::path& output, const std::string& help);
void addTime(CLI::App& command, double& time);
void addSize(CLI::App& command, uvec2& size);  // pixels
void addDevice(CLI::App& command, std::string& device);
void addQuiet(CLI::App& command, bool& isQuiet);
void addRepeat(CLI::App& command, uint32_t& repeat);
void addStats(CLI::App& command, std::filesystem::path& stats);
// `takesWord`: the setting's word for zero is taken too. `owner` outlives the command line.
void addSetting(CLI::App& command, const Setting& setting, void* owner, const std::string& group,
                bool takesWord = false);
void addSettings(CLI::App& command, std::span<const SettingsView> views, bool takesWord = false);
// Which technique, and the settings of every owner that a picture, or a sensor, depends on.
void addTechnique(CLI::App& command, PictureSettings& settings);
void addTechniqueOfSensor(CLI::App& command, PictureSettings& settings);
// The settings alone.
void addPictureSettings(CLI::App& command, PictureSettings& settings);

// Throws, before any work is done, where `file` cannot be written, ends in none of `extensions` (none given:
// any will do) or is the scene itself.
void checkOutput(const std::filesystem::path& file, const std::filesystem::path& scene,
                 std::initializer_list<const char*> extensions = {});

// For CLI11's check(): empty where the value is one of `names`, or else what is wrong and which is nearest.
std::function<std::string(const std::string&)> oneOf(std::vector<std::string> names);

// "A<separator>B", both whole numbers; empty where it is not that.
std::optional<uvec2> pairOf(const std::string& text, char separator);

// The truth for the techniques, which runs without them and is chosen by --technique as they are.
inline constexpr const char* kReferenceName = "reference";
bool isReference(const PictureSettings& settings);

// The names of all techniques.
std::vector<std::string> techniqueList();

// "a, b, c".
std::string joined(const std::vector<std::string>& names, const std::string& between = ", ");

// The program and its arguments as a shell would be given them.
const std::string& commandLine();

// What an EXR says of how it was made. Neither a time nor a place, so that the same command writes the same
// bytes.
std::vector<ImageAttribute> imageAttributes(const PictureSettings& settings, const std::string& unit);

void writeStats(const std::filesystem::path& file, const Stats& stats);

}  // namespace nephroid
