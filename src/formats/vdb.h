// Reads OpenVDB files, if the program was built with that library.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace nephroid {

// Reads the active part of the grid of floats called `name`; without a name, of the first such grid.
// Positions are those of the file (m), and densities are divided by the largest one. Throws InputError with
// the file's name where there is no such grid, where its axes are turned, or where the program was built
// without OpenVDB.
DensityGrid loadVdb(const std::filesystem::path& file, const std::string& name);

}  // namespace nephroid
