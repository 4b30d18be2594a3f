// Images made by the renderer and the sensors: layers of floats, found by name.
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

// Row 0 is the top row of a picture. In a sensor's image, it is the row at the sensor's corner.
struct Image {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<ImageChannel> channels;

  std::size_t pixelCount() const { return std::size_t{width} * height; }
  // The values of a channel. A missing channel is added, filled with zeros. The reference is valid until a
  // channel is added.
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
