#include "techniques/adaptive_beams/level_picture.h"

#include <algorithm>
#include <cstdio>

#include "gpu/command_list.h"
#include "shaders/techniques/adaptive_beams/levels_frag.h"
#include "shaders/techniques/whole_picture_vert.h"
#include "techniques/adaptive_beams/level_picture_data.h"
#include "techniques/level_color.h"

namespace nephroid {
namespace {

constexpr VkFormat kBytes = VK_FORMAT_R8G8B8A8_UNORM;

std::string texelOf(float cellSize, uint32_t level) {
  char text[32];
  const double texel = 1000 * double(cellSize) / double(kTileTexels) / double(1u << level);  // mm
  std::snprintf(text, sizeof text, "%.3g mm", texel);
  return text;
}

}  // namespace

std::vector<uint64_t> cellsAtLevels(const LandedLight& light) {
  std::vector<uint64_t> counts;
  std::vector<uint32_t> level;
  for (uint32_t cell = 0; cell < light.grid.cells.x * light.grid.cells.y * light.grid.cells.z * kFaces;
       ++cell)
    level.push_back(cell);
  for (std::vector<uint32_t> finer; !level.empty(); level.swap(finer), finer.clear()) {
    uint64_t& count = counts.emplace_back(0);
    for (const uint32_t cell : level) {
      const LandedCell& own = light.cells[cell];
      // Where a child is missing, its own tile is read.
      if (own.tile != kNoTile && std::ranges::count(own.children, 0u) > 0) ++count;
      for (const uint32_t child : own.children)
        if (child != 0) finer.push_back(child);
    }
  }
  while (!counts.empty() && counts.back() == 0) counts.pop_back();
  return counts;
}

const gpu::Image* LevelPicture::draw(const LandedLight& light, const gpu::Image& cells,
                                     const gpu::Sampler& sampler, const ReceiverPoints& points,
                                     Legend& legend) {
  const uvec2 size(points.position->width(), points.position->height());
  if (!program_)
    program_ =
        gpu::createRasterProgram(device_, "levels of landed light", shaders::techniques_whole_picture_vert,
                                 shaders::techniques_adaptive_beams_levels_frag, {.colors = {{kBytes}}});
  if (!picture_ || uvec2(picture_.width(), picture_.height()) != size)
    picture_ = gpu::createImage(device_, "levels of landed light",
                                {.format = kBytes, .width = size.x, .height = size.y});
  const std::vector<uint64_t> counts = cellsAtLevels(light);
  LevelPictureConstants constants{light.grid, 0, uint32_t(counts.size())};
  while (constants.first < counts.size() && counts[constants.first] == 0) ++constants.first;
  constants.count -= constants.first;
  if (counts.empty()) constants.grid.cellSize = 1;  // and no cells
  device_.submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("levels of landed light", [&] {
      commands.render({.colors = {{&picture_, 0, std::nullopt}}}, [&] {
        commands.draw(program_, 3, 1, constants,
                      {{"receiverPosition", *points.position},
                       {"receiverNormal", *points.normal},
                       {"cells", cells, sampler}});
      });
    });
  });
  legend = {"Texels of landed light", "cells", {}};
  for (uint32_t level = constants.first; level < counts.size(); ++level)
    legend.entries.push_back({levelColor(level - constants.first, constants.count),
                              texelOf(light.grid.cellSize, level), counts[level]});
  return &picture_;
}

}  // namespace nephroid
