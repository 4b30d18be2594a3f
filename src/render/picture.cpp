#include "render/picture.h"

namespace nephroid {

ByteImage pictureOf(const Image& image, const ToneMapping& toneMapping, const std::string& layer,
                    Rounding rounding) {
  const std::vector<float>& red = *image.find(layer + "R");
  const std::vector<float>& green = *image.find(layer + "G");
  const std::vector<float>& blue = *image.find(layer + "B");
  ByteImage picture{image.width, image.height, 3, {}};
  picture.bytes.reserve(3 * red.size());
  for (std::size_t i = 0; i < red.size(); ++i) {
    const vec3 shown = displayed({red[i], green[i], blue[i]}, toneMapping);
    const vec3 levels = rounding == Rounding::nearest
                            ? floor(255.0f * shown + 0.5f)
                            : levelsOf(shown, uint(i % image.width), uint(i / image.width));
    for (int c = 0; c < 3; ++c) picture.bytes.push_back(levels[c] > 0 ? uint8_t(levels[c]) : 0);
  }
  return picture;
}

}  // namespace nephroid
