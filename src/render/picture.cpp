#include "render/picture.h"

#include "render/tone_mapping.h"

namespace nephroid {

ByteImage pictureOf(const Image& image, float exposure, const std::string& layer) {
  const std::vector<float>& red = *image.find(layer + "R");
  const std::vector<float>& green = *image.find(layer + "G");
  const std::vector<float>& blue = *image.find(layer + "B");
  ByteImage picture{image.width, image.height, 3, {}};
  picture.bytes.reserve(3 * red.size());
  for (std::size_t i = 0; i < red.size(); ++i) {
    const vec3 shown = displayed({red[i], green[i], blue[i]}, exposure);
    for (int c = 0; c < 3; ++c) picture.bytes.push_back(shown[c] > 0 ? uint8_t(shown[c] * 255.0f + 0.5f) : 0);
  }
  return picture;
}

}  // namespace nephroid
