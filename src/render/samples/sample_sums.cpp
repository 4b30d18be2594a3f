#include "render/samples/sample_sums.h"

#include <array>

#include "core/color.h"
#include "gpu/transfer.h"
#include "render/samples/mean_data.h"
#include "shaders/render/samples/mean_frag.h"
#include "shaders/techniques/whole_picture_vert.h"

namespace nephroid {
namespace {

struct Layer {
  const char* image;   // its name on the device
  const char* prefix;  // of its channels
};

// As layers.frag writes them.
constexpr std::array<Layer, 4> kLayers{{{"luminance", ""},
                                        {"direct luminance", "direct."},
                                        {"caustics luminance", "caustics."},
                                        {"luminance of the air", "shafts."}}};

}  // namespace

SampleSums::SampleSums(gpu::Device& device, ToneCurve tone) : device_(device) {
  setTone(tone);
}

void SampleSums::setTone(ToneCurve tone) {
  mean_ = gpu::createRasterProgram(
      device_, "mean of samples", shaders::techniques_whole_picture_vert, shaders::render_samples_mean_frag,
      {.colors = {{VK_FORMAT_R8G8B8A8_UNORM}}}, {{"kToneCurve", uint32_t(tone)}});
}

void SampleSums::resize(uvec2 size) {
  size_ = size;
  count_ = 0;
  sums_.clear();
}

std::vector<const gpu::Image*> SampleSums::add() {
  if (sums_.empty())
    for (const Layer& layer : kLayers)
      sums_.push_back(gpu::createImage(device_, layer.image, {.width = size_.x, .height = size_.y}));
  ++count_;
  std::vector<const gpu::Image*> images;
  for (const gpu::Image& sum : sums_) images.push_back(&sum);
  return images;
}

void SampleSums::recordMean(gpu::CommandList& commands, float exposure, const gpu::Image& picture) const {
  commands.render({.colors = {{&picture, 0, std::nullopt}}}, [&] {
    commands.draw(mean_, 3, 1, MeanConstants{1 / float(count_), exposure}, {{"luminance", sums_.front()}});
  });
}

void SampleSums::read(Image& layers) const {
  constexpr std::array<const char*, 3> kColors{"R", "G", "B"};
  const float part = 1 / float(count_);
  for (std::size_t layer = 0; layer < kLayers.size(); ++layer) {
    const auto texels = gpu::download<vec4>(device_, sums_[layer]);
    for (int c = 0; c < 3; ++c) {
      std::vector<float>& values =
          layers.channel(std::string(kLayers[layer].prefix) + kColors[std::size_t(c)]);
      for (std::size_t i = 0; i < texels.size(); ++i) values[i] = part * texels[i][c];
    }
  }
}

std::vector<float> SampleSums::luminances() const {
  const float part = 1 / float(count_);
  const auto texels = gpu::download<vec4>(device_, sums_.front());
  std::vector<float> all;
  all.reserve(texels.size());
  for (const vec4& texel : texels) all.push_back(part * luminanceOf(vec3(texel)));
  return all;
}

}  // namespace nephroid
