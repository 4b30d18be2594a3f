// Photometric files: IES LM-63 of 1986, 1991, 1995, 2002 and 2019.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace nephroid {

// Reads the profile of an LM-63 file of photometric type A, B or C. The candela multiplier and the ballast
// factors are included in its peak. Keywords, the lamp's size and TILT=INCLUDE are checked but not used.
// Throws InputError, with the line, where the file is wrong, where it refers to another file for tilt
// factors, or where all its values are 0.
Profile loadIes(const std::filesystem::path& file);

// As above, from the text of a file; `source` begins every error.
Profile readIes(const std::string& text, const std::string& source);

}  // namespace nephroid
