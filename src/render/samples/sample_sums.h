// Adds up the luminance of several samples of each pixel. The picture is made of their mean, before the tone
// curve.
#pragma once

#include <vector>

#include "core/image.h"
#include "gpu/command_list.h"
#include "gpu/program.h"
#include "gpu/resources.h"
#include "scene/tone_curve.h"

namespace nephroid {

class SampleSums {
 public:
  // The device must outlive it.
  SampleSums(gpu::Device& device, ToneCurve tone);

  // Sets another curve for the following pictures.
  void setTone(ToneCurve tone);

  // Sets another size (pixels) for the following pictures. Nothing is summed then.
  void resize(uvec2 size);

  // Begins a new sum. Its images are made when something is first added.
  void begin() { count_ = 0; }
  uint32_t count() const { return count_; }  // samples in the sum

  // Counts one more sample, and returns the images (rgba32f, nit) to which layers.frag is to add it, in its
  // order; the first sample clears them. Not while commands are recorded.
  std::vector<const gpu::Image*> add();

  // Writes the picture of the mean: exposed, tone-mapped, sRGB.
  void recordMean(gpu::CommandList& commands, float exposure, const gpu::Image& picture) const;

  // Writes the mean to the layers' R,G,B, direct.R,G,B, caustics.R,G,B and shafts.R,G,B.
  void read(Image& layers) const;

  // The mean luminance (nit) of each pixel.
  std::vector<float> luminances() const;

 private:
  gpu::Device& device_;
  gpu::Program mean_;
  uvec2 size_{0};
  uint32_t count_ = 0;
  std::vector<gpu::Image> sums_;
};

}  // namespace nephroid
