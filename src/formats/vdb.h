// OpenVDB files, where the program was built with the library.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace nephroid {

// The grid of floats called `name`, the first of them where that is empty, as far as it is active: in the
// file's own space, the densest 1. Throws InputError, naming the file, where there is no such grid, where its
// axes are not those of the world, and where this program reads no such files.
DensityGrid loadVdb(const std::filesystem::path& file, const std::string& name);

}  // namespace nephroid
