// Skies from image files.
#pragma once

#include <filesystem>

#include "scene/light.h"

namespace nephroid {

// An EXR in equal angles (longitude, latitude), channels R, G, B in nit. Throws InputError where it is not
// one, or dark all over, or below 0 anywhere.
SkyMap loadSky(const std::filesystem::path& file);

}  // namespace nephroid
