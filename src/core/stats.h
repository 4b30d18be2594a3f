// The figures that a run reports with `--stats FILE.json`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nephroid {

struct PassTime {
  std::string name;
  double milliseconds = 0;
  uint32_t samples = 1;  // of each pixel, that the time is of; 1 too for what is made once for all of them
};

// What became of the light onto casters, in lumen of luminance.
struct LightBudget {
  double incident = 0;
  double landed = 0;        // where it is wanted
  double lost = 0;          // in casters: trapped, or at holes of open ones
  double shaded = 0;        // stopped by something before the casters
  double missed = 0;        // by way of casters, but not to where it is wanted
  bool isLossTold = false;  // what is lost ought not to be; without reflection, it is by definition
};

struct Stats {
  std::string device;     // the Vulkan device, by its driver's name
  std::string technique;  // "illumination-textures", "none"
  std::string source;     // "table", "traced"
  // All settings, as they are written on the command line: {"planes", "4"}.
  std::vector<std::pair<std::string, std::string>> settings;
  double prepareMilliseconds =
      0;  // work done once: loading, tables, all that does not change when a light moves
  // Median over the frames; each does all work that a moved light would need, and draws all samples.
  double frameMilliseconds = 0;
  std::vector<PassTime> passes;  // of the median frame, in the order they ran
  std::vector<std::pair<std::string, uint64_t>>
      counts;                // "vertices", "beams", "rays", and others that depend on the technique
  uint64_t memoryBytes = 0;  // on the device
  // Of a technique that works to an error that is asked for: what it claims to have reached, and the part of
  // the light that it left out.
  std::optional<double> error, leftOut;
  std::optional<double> exposure;  // of pictures: what multiplied their luminance (nit)
  std::string shortfall;  // a sentence where the error that was asked for is not reached; otherwise empty
  std::optional<LightBudget> budget;  // of a technique that knows it
  std::vector<std::string> warnings;  // what was mended in the scene, or cannot be right
  std::vector<std::string> notes;     // why light is missing, or may be off
};

// Adds a line that is not there yet.
void addLine(std::vector<std::string>& lines, const std::string& line);

// Sets a count and replaces the old one of that name.
void setCount(Stats& stats, const std::string& name, uint64_t count);

// {"schema": "nephroid stats 2", "device", "technique", "source", "settings": {...}, "error", "left_out",
// "exposure", "shortfall", "notes": [...], "prepare_ms", "frame_ms", "passes": [{"name", "ms", "samples"}],
// "counts":
// {...}, "memory_bytes"}; the notes begin with the warnings; error and left_out are null where the technique
// knows none, exposure where there is no picture.
std::string statsJson(const Stats& stats);

// The middle value, or the mean of the middle two where there is an even number. 0 for an empty list.
double median(std::vector<double> values);

}  // namespace nephroid
