#include "core/stats.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace nephroid {

void setCount(Stats& stats, const std::string& name, uint64_t count) {
  for (auto& [known, value] : stats.counts)
    if (known == name) {
      value = count;
      return;
    }
  stats.counts.emplace_back(name, count);
}

void addLine(std::vector<std::string>& lines, const std::string& line) {
  if (std::ranges::find(lines, line) == lines.end()) lines.push_back(line);
}

std::string statsJson(const Stats& stats) {
  using Json = nlohmann::ordered_json;
  Json passes = Json::array();
  for (const PassTime& pass : stats.passes)
    passes.push_back({{"name", pass.name}, {"ms", pass.milliseconds}, {"samples", pass.samples}});
  Json counts = Json::object();
  for (const auto& [name, count] : stats.counts) counts[name] = count;
  Json settings = Json::object();
  for (const auto& [flag, value] : stats.settings) settings[flag] = value;
  Json notes = stats.warnings;
  for (const std::string& note : stats.notes) notes.push_back(note);
  const auto orNull = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
  const Json document = {{"schema", "nephroid stats 2"},
                         {"device", stats.device},
                         {"technique", stats.technique},
                         {"source", stats.source},
                         {"settings", settings},
                         {"error", orNull(stats.error)},
                         {"left_out", orNull(stats.leftOut)},
                         {"exposure", orNull(stats.exposure)},
                         {"shortfall", stats.shortfall},
                         {"notes", notes},
                         {"prepare_ms", stats.prepareMilliseconds},
                         {"frame_ms", stats.frameMilliseconds},
                         {"passes", passes},
                         {"counts", counts},
                         {"memory_bytes", stats.memoryBytes}};
  // A driver's name may hold bytes that are not UTF-8; they are replaced rather than refused.
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace nephroid
