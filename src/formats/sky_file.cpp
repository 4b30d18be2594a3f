#include "formats/sky_file.h"

#include "core/color.h"
#include "core/error.h"
#include "core/image_io.h"

namespace nephroid {

SkyMap loadSky(const std::filesystem::path& file) {
  const Image image = isRadiance(file) ? readRadiance(file) : readExr(file);
  SkyMap sky{file.string(), {image.width, image.height}, {}};
  sky.luminance.resize(std::size_t{image.width} * image.height);
  for (int c = 0; c < 3; ++c) {
    const std::vector<float>* channel = image.find(std::string(1, "RGB"[c]));
    if (!channel)
      throw InputError("it has no channel " + std::string(1, "RGB"[c]) + "; a sky needs R, G and B");
    for (std::size_t i = 0; i < sky.luminance.size(); ++i) sky.luminance[i][c] = (*channel)[i];
  }
  bool isDark = true;
  for (const vec3& luminance : sky.luminance) {
    if (!(glm::all(glm::greaterThanEqual(luminance, vec3(0))) && luminanceOf(luminance) < 1e12f))
      throw InputError("it has a luminance below 0 or without end; all of a sky must be from 0 to 1e12 nit");
    isDark = isDark && luminance == vec3(0);
  }
  if (isDark) throw InputError("it is dark all over; a sky must shine somewhere");
  return sky;
}

}  // namespace nephroid
