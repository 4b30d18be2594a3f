// How far irradiance volumes are from the truth: parts of the table of paper 3.
#pragma once

#include <filesystem>

#include "papers/paper_tables.h"

namespace nephroid {

// Figure 11: the floor under a sphere and within a ring, by kilobytes per light sample and representation.
void addMemoryErrors(PaperTable& table, const std::filesystem::path& scenes, Progress& progress);

// Light through planes across the light, by representation, as a part of what is traced through them.
void addFluxes(PaperTable& table, const std::filesystem::path& scenes);

// A light that turns by 10 degrees between the sampled directions, by the way of interpolation: what changes
// from frame to frame that should not, and the error of the frames.
void addMotionErrors(PaperTable& table, const std::filesystem::path& scenes, Progress& progress);

}  // namespace nephroid
