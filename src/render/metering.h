// The exposure of pictures that are given none.
#pragma once

#include <vector>

#include "core/image.h"
#include "render/tone_mapping.h"
#include "scene/scene.h"

namespace nephroid {

// The exposure that brings a picture's log-average luminance to its key (Reinhard et al., "Photographic tone
// reproduction for digital images", 2002, equation 1). The key is 0.18, and less where most of the picture
// is dark beside its bright parts, more where it is the other way round, as in Reinhard, "Parameter
// estimation for photographic tone reproduction", 2002, but half as far in stops: 0.09 to 0.22. Luminance
// (nit) is clipped to its percentiles 1 and 99. What is black, or too dim to be seen beside percentile 99,
// does not count. 1 where all is black. The order of the pixels does not matter, but for rounding.
float meteredExposure(const std::vector<float>& luminances);
float meteredExposure(const Image& image);  // of R, G and B (nit)

// How the camera shows the image.
ToneMapping toneMappingOf(const Camera& camera, const Image& image);
// The same, where the exposure is known.
ToneMapping toneMappingOf(float exposure, ToneCurve curve);

}  // namespace nephroid
