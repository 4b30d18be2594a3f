#include "irradiance_volume/sample.h"

#include <algorithm>

namespace nephroid {

VolumeLight lightAt(const SampleLayout& layout, std::span<const uint32_t> words, uint32_t representation,
                    vec3 place) {
  return volumeLight({layout.size, words.data()}, representation,
                     (place - layout.corner) * layout.placesPerUnit);
}

void packCell(const CellSum& cell, uint32_t* words) {
  constexpr float kLargestHalf = 65504.0f;
  const vec3 vector = clamp(cell.vector, vec3(-kLargestHalf), vec3(kLargestHalf));
  const float sum = cell.color.x + cell.color.y + cell.color.z;
  const vec3 parts = sum > 0 ? cell.color / sum : vec3(1 / 3.0f);
  const auto red = uint32_t(255 * parts.x + 0.5f);
  const auto blue = std::min(uint32_t(255 * parts.z + 0.5f), 255 - red);
  words[0] = glm::packHalf2x16(vec2(vector.x, vector.y));
  words[1] = glm::packHalf2x16(vec2(vector.z, 0)) | red << 16 | blue << 24;
}

}  // namespace nephroid
