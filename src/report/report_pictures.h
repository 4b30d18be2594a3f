// The pictures of a report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/comparison.h"

namespace nephroid {

// The scale of a false-color picture: from 0 (or from -bound where it is signed) to bound.
struct ColorScale {
  bool isSigned = false;
  double bound = 1;
  std::string unit;  // "nit", "lux", "%"; empty for a plain number
};

// Pictures of the reference and the techniques in the same way, to be compared by switching.
struct PictureView {
  std::string name;
  std::optional<ColorScale> scale;
  ByteImage reference;
  std::vector<ByteImage> techniques;
};

struct ErrorMap {
  std::string name;
  ColorScale scale;
  ByteImage picture;
};

struct SidePictures {
  std::vector<PictureView> views;
  std::vector<std::vector<ErrorMap>> maps;  // of each technique
};

// `errors` are those of `pair`. A camera is shown as pictures, a sensor in false color.
SidePictures picturesOf(const SideBySide& pair, const std::vector<Errors>& errors,
                        const ToneMapping& toneMapping);

}  // namespace nephroid
