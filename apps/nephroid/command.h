// A command of the program: its options, then what it does with them.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/stats.h"
#include "techniques/settings.h"

namespace nephroid {

// `run` is called after the whole command line is understood.
struct Command {
  const CLI::App* app;
  std::function<void()> run;
};

// Each declares its options on a subcommand of `program`.
Command addInfo(CLI::App& program);

// What most commands share.
struct CommonOptions {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::filesystem::path stats;  // empty: none
  std::filesystem::path baked;  // empty: found in the cache, or made
  std::string device;           // empty: the best there is
  double time = 0;              // s
  uint32_t repeat = 1;
  bool isQuiet = false;
};

void addScene(CLI::App& command, std::filesystem::path& scene);
void addOutput(CLI::App& command, std::filesystem::path& output, const std::string& help);
void addTime(CLI::App& command, double& time);
void addDevice(CLI::App& command, std::string& device);
void addQuiet(CLI::App& command, bool& isQuiet);
void addMeasuring(CLI::App& command, CommonOptions& options);
// `isSensorKnown`: a plane may be put where the sensor is.
void addTechnique(CLI::App& command, TechniqueSettings& settings, bool isSensorKnown);

// Throws, before any work is done, where `file` cannot be written, ends in none of `extensions` (none given:
// any will do) or is the scene itself.
void checkOutput(const std::filesystem::path& file, const std::filesystem::path& scene,
                 std::initializer_list<const char*> extensions = {});

void writeStats(const std::filesystem::path& file, const Stats& stats);

}  // namespace nephroid
