// Photometric files: IES LM-63 of 1986, 1991, 1995, 2002 and 2019.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace nephroid {

// The profile in an LM-63 file of photometric type A, B or C, with its candela multiplier and ballast factors
// in its peak. Keywords, sizes and TILT=INCLUDE are checked and left out: the values hold as they were
// measured. Throws InputError with the line where the file is wrong, names a file of tilt factors, or gives
// no light.
Profile loadIes(const std::filesystem::path& file);

// As above, from the text of a file; `source` begins every error.
Profile readIes(const std::string& text, const std::string& source);

}  // namespace nephroid
