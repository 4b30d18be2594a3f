// The commands of the program, and the options that several of them share.
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
#include "render/tone_mapping.h"
#include "scene/scene.h"

namespace nephroid {

// `run` does the work. It is called after the whole command line has been parsed.
struct Command {
  const CLI::App* app;
  std::function<void()> run;
};

// Each of these adds one subcommand with its options to `program`.
Command addRender(CLI::App& program);
Command addMeasure(CLI::App& program);
Command addBake(CLI::App& program);
Command addCompare(CLI::App& program);
Command addBench(CLI::App& program);
Command addInfo(CLI::App& program);
Command addHelp(CLI::App& program);
Command addView(CLI::App& program);

// The options that most commands share.
struct CommonOptions {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::filesystem::path stats;  // empty: none
  std::string device;           // index or part of a name; empty: the best device
  double time = 0;              // s
  uint32_t repeat = 1;
  bool isQuiet = false;
};

void addScene(CLI::App& command, std::filesystem::path& scene);
void addOutput(CLI::App& command, std::filesystem::path& output, const std::string& help);
void addTime(CLI::App& command, double& time);
void addSize(CLI::App& command, uvec2& size);  // pixels
// --exposure and --tone.
void addTone(CLI::App& command, ToneChoice& choice);
void addDevice(CLI::App& command, std::string& device);
void addQuiet(CLI::App& command, bool& isQuiet);
void addRepeat(CLI::App& command, uint32_t& repeat);
void addStats(CLI::App& command, std::filesystem::path& stats);
// Adds an option for each setting. With `takesWord` the option also accepts the setting's word for zero.
// `owner` is the struct that holds the value; it must outlive `command`.
void addSetting(CLI::App& command, const Setting& setting, void* owner, const std::string& group,
                bool takesWord = false);
void addSettings(CLI::App& command, std::span<const SettingsView> views, bool takesWord = false);
// Adds --technique and all settings that a picture (or, in the second function, a sensor) depends on.
void addTechnique(CLI::App& command, PictureSettings& settings);
void addTechniqueOfSensor(CLI::App& command, PictureSettings& settings);
// Adds these settings without --technique.
void addPictureSettings(CLI::App& command, PictureSettings& settings);

// Checks an output file before any work is done. Throws InputError or RuntimeFailure where `file` cannot be
// written, is the scene itself, or has none of the `extensions`. Without `extensions` any extension is
// accepted.
void checkOutput(const std::filesystem::path& file, const std::filesystem::path& scene,
                 std::initializer_list<const char*> extensions = {});

// A check for CLI11. It returns an empty text where the value is one of `names`; otherwise it returns the
// error message, with the nearest name.
std::function<std::string(const std::string&)> oneOf(std::vector<std::string> names);

// Reads two whole numbers from "A<separator>B". Empty where `text` has another form.
std::optional<uvec2> pairOf(const std::string& text, char separator);

// The reference is not a technique, but users choose it with --technique too.
inline constexpr const char* kReferenceName = "reference";
// What else the technique is called that is used where none is named.
inline constexpr const char* kAutomaticName = "automatic";
bool isReference(const PictureSettings& settings);

// The names of all techniques.
std::vector<std::string> techniqueList();

// "a, b, c".
std::string joined(const std::vector<std::string>& names, const std::string& between = ", ");

// The program and its arguments, quoted for a shell.
const std::string& commandLine();

// The attributes of an EXR that tell how it was made. They contain no date and no folder, so that the same
// command writes the same bytes.
std::vector<ImageAttribute> imageAttributes(const PictureSettings& settings, const std::string& unit);

// The attributes of a camera's EXR that tell how a picture of it is shown.
void addToneAttributes(const ToneMapping& toneMapping, std::vector<ImageAttribute>& attributes);

// Tells on standard error what was mended in the scene's meshes, or cannot be right; each line once in a run.
void warnOf(const Scene& scene, Stats& stats);

// Tells on standard error why light is missing and where an error that was asked for is not reached, and
// writes the figures where a file is given.
void reportStats(const std::filesystem::path& file, const Stats& stats);

}  // namespace nephroid
