// The errors of irradiance volumes against the reference: parts of the table of paper 3.
#pragma once

#include <filesystem>

#include "papers/paper_tables.h"

namespace nephroid {

// Figure 11: the errors on the floor under a sphere and within a ring, for each representation and number of
// kilobytes per light sample.
void addMemoryErrors(PaperTable& table, const std::filesystem::path& scenes, Progress& progress);

// The flux through planes across the light, as a part of the traced flux, for each representation.
void addFluxes(PaperTable& table, const std::filesystem::path& scenes);

// A light that turns by 10 degrees between the sampled directions, for each way of interpolation: wrong
// changes from frame to frame, and the errors of the frames.
void addMotionErrors(PaperTable& table, const std::filesystem::path& scenes, Progress& progress);

}  // namespace nephroid
