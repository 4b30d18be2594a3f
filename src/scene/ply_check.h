#pragma once

#include <string>

namespace nephroid {

// Throws InputError, beginning with `source`, unless the header of a PLY file and the counts in it and in its
// lists agree with the bytes that are there. Assimp makes room for whatever they say before it looks.
void requirePlausiblePly(const std::string& bytes, const std::string& source);

}  // namespace nephroid
