// Test data that is not in the repository.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace nephroid {

inline std::filesystem::path sharedData() {
  const char* variable = std::getenv("NEPHROID_SHARED");
  return variable ? std::filesystem::path(variable)
                  : std::filesystem::path(NEPHROID_SOURCE_DIR) / ".." / "shared";
}

}  // namespace nephroid
