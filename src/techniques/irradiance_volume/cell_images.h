// The cells of an irradiance volume as images, which devices filter faster than words in a buffer.
#pragma once

#include <span>

#include "gpu/command_list.h"

namespace nephroid {

struct CellImages {
  gpu::Image vectors;  // rgba16f, one layer for each z; a: the cell's brightness, the weight of its color in
                       // lookup.h
  gpu::Image
      tints;      // rg16f, a times the red and the blue part; not created where all cells have the same color
  vec3 color{1};  // the common color, with a mean of 1
  gpu::Buffer staged;
};

// Prepares `size` cells, which begin after `first` other cells in `words`. The device must not be using the
// images.
void stageCells(gpu::Device& device, CellImages& images, uvec3 size, uint32_t first,
                std::span<const uint32_t> words);

// The size of the images in bytes.
uint64_t cellBytes(const CellImages& images);

// Copies the prepared cells to the images.
void copyCells(gpu::CommandList& commands, const CellImages& images);

}  // namespace nephroid
