// The settings of light transport through casters.
#pragma once

#include <array>
#include <filesystem>

#include "core/settings.h"
#include "trace/paths.h"

namespace nephroid {

enum class Source { table, traced };

inline constexpr std::array<const char*, 2> kSourceNames{"table", "traced"};
constexpr const auto& namesOf(Source) {
  return kSourceNames;
}

struct TransportSettings {
  Source source = Source::traced;
  Paths paths = Paths::all;
  uint32_t directions = 129;    // for each vertex of a light transport table
  std::filesystem::path baked;  // file of tables; empty: they are taken from the cache, or built
  bool operator==(const TransportSettings&) const = default;
};

// All settings but `baked`, for which there is an option of its own.
std::span<const Setting> transportSettings();

}  // namespace nephroid
