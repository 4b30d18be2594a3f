// The kinds of errors, and the search for the name that the user may have meant.
#pragma once

#include <stdexcept>
#include <string>

namespace nephroid {

// The input is wrong; the exit status is 2. The message is one line: what is wrong, in which file and line or
// key, and what would be right.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The input is right, but the work cannot be done here (no memory, no device, a file that cannot be written).
// The exit status is 1.
struct RuntimeFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The user pressed Ctrl-C. Files that were not complete are removed.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
  using std::runtime_error::runtime_error;
};

// The name in `known` that is nearest to `name` by edit distance. Empty where no name is near enough.
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
