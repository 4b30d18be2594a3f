// Skies from image files.
#pragma once

#include <filesystem>

#include "scene/light.h"

namespace nephroid {

// Reads an EXR or a Radiance image whose columns are longitudes and whose rows are latitudes, in equal steps;
// channels R, G, B in nit. Throws InputError where the file is no such image, where all values are 0, or
// where a value is negative.
SkyMap loadSky(const std::filesystem::path& file);

}  // namespace nephroid
