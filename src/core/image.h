// Pictures as the renderer and the sensors make them: float layers that are found by name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

struct ImageChannel {
  std::string name;           // as in an EXR file: "R", "direct.R", "depth.Z"
  std::vector<float> values;  // width * height, row by row, the first row at the top
};

// Row 0 is the top of a picture, and the row of a sensor that begins at its corner.
struct Image {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<ImageChannel> channels;

  std::size_t pixelCount() const { return std::size_t{width} * height; }
  // The values of a channel, made (all zero) where there was none. A reference lasts until a channel is made.
  std::vector<float>& channel(std::string_view name);
  // Null where there is no such channel.
  const std::vector<float>* find(std::string_view name) const;
};

// Eight bits a component, interleaved, the first row at the top.
struct ByteImage {
  uint32_t width = 0;
  uint32_t height = 0;
  uint32_t components = 3;  // 3: RGB, 4: RGBA
  std::vector<uint8_t> bytes;
};

}  // namespace nephroid
