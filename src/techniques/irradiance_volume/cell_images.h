// Cells of an irradiance volume as images, which devices filter faster than they read words.
#pragma once

#include <span>

#include "gpu/command_list.h"

namespace nephroid {

struct CellImages {
  gpu::Image vectors;  // rgba16f, a layer for each z; a: how bright the cell is, as lookup.h weighs colours
  gpu::Image tints;    // rg16f: the red and the blue part of that; none where all cells have one colour
  vec3 color{1};       // that colour, of mean 1
  gpu::Buffer staged;
};

// Takes `size` cells from `words`, which hold them after `first` others. Nothing is in use by the device.
void stageCells(gpu::Device& device, CellImages& images, uvec3 size, uint32_t first,
                std::span<const uint32_t> words);

// Of the images.
uint64_t cellBytes(const CellImages& images);

// Puts into the images what was staged.
void copyCells(gpu::CommandList& commands, const CellImages& images);

}  // namespace nephroid
