// What a run reports of itself: the object behind `--stats FILE.json`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace nephroid {

struct PassTime {
  std::string name;
  double milliseconds = 0;
};

struct Stats {
  std::string device;     // what drew, as its driver names it
  std::string technique;  // "illumination-textures", "none"
  std::string source;     // "table", "traced"
  // What was chosen, as the command line takes it: {"planes", "4"}.
  std::vector<std::pair<std::string, std::string>> settings;
  double prepareMilliseconds = 0;  // once: loading, tables, what a moved light leaves as it is
  double frameMilliseconds = 0;    // median over the frames; all that a moved light would change
  std::vector<PassTime> passes;    // of the median frame, in the order they ran
  std::vector<std::pair<std::string, uint64_t>>
      counts;                // "vertices", "beams", "rays": as many as there is to tell
  uint64_t memoryBytes = 0;  // on the device
};

// In place of the count of that name, if there is one.
void setCount(Stats& stats, const std::string& name, uint64_t count);

// {"device", "technique", "source", "settings": {...}, "prepare_ms", "frame_ms", "passes": [{"name", "ms"}],
// "counts": {...}, "memory_bytes"}
std::string statsJson(const Stats& stats);

// The middle value; the mean of the middle two where their number is even; 0 of none.
double median(std::vector<double> values);

}  // namespace nephroid
