#include "viewer/show/edge_smoothing.h"

#include "shaders/techniques/whole_picture_vert.h"
#include "shaders/viewer/show/smooth_edges_frag.h"

namespace nephroid {

EdgeSmoothing::EdgeSmoothing(gpu::Device& device)
    : device_(device),
      program_(gpu::createRasterProgram(device, "smooth edges", shaders::techniques_whole_picture_vert,
                                        shaders::viewer_show_smooth_edges_frag,
                                        {.colors = {{VK_FORMAT_R8G8B8A8_UNORM}}})),
      sampler_(gpu::createSampler(device)) {}

const gpu::Image& EdgeSmoothing::smooth(const gpu::Image& picture, std::vector<PassTime>& passes) {
  const uvec2 size(picture.width(), picture.height());
  if (!smoothed_ || uvec2(smoothed_.width(), smoothed_.height()) != size)
    smoothed_ = gpu::createImage(device_, "smoothed picture",
                                 {.format = picture.format(), .width = size.x, .height = size.y});
  const std::vector<PassTime> times = device_.submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("smooth edges", [&] {
      commands.render({.colors = {{&smoothed_, 0, std::nullopt}}}, [&] {
        commands.draw(program_, 3, 1, gpu::NoConstants{}, {{"picture", picture, sampler_}});
      });
    });
  });
  passes.insert(passes.end(), times.begin(), times.end());
  return smoothed_;
}

}  // namespace nephroid
