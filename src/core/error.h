#pragma once

#include <stdexcept>
#include <string>

namespace nephroid {

// The input is wrong: exit status 2. The message is one line: what, in which file and line or key, and what
// would be right.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The input is right, but it could not be done here (no memory, no device, a file not writable): exit
// status 1.
struct RuntimeFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Ctrl-C: whatever was being written is thrown away.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
  using std::runtime_error::runtime_error;
};

// Of `known`, the name nearest to `name` by edit distance; empty when none is near enough to be meant.
template <class Range>
std::string nearestName(const std::string& name, const Range& known);

// Levenshtein distance.
std::size_t editDistance(const std::string& a, const std::string& b);

template <class Range>
std::string nearestName(const std::string& name, const Range& known) {
  std::string best;
  std::size_t bestDistance = name.size() / 2 + 2;
  for (const auto& candidate : known) {
    const std::size_t distance = editDistance(name, std::string(candidate));
    if (distance < bestDistance) {
      bestDistance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace nephroid
