#include "viewer/show/edge_smoothing.h"

#include "shaders/techniques/whole_picture_vert.h"
#include "shaders/viewer/show/mark_edges_frag.h"
#include "shaders/viewer/show/smooth_edges_frag.h"

namespace nephroid {
namespace {

constexpr VkFormat kSmoothedFormat = VK_FORMAT_R8G8B8A8_UNORM;
constexpr VkFormat kMarkFormat = VK_FORMAT_D32_SFLOAT;

gpu::Program edgeProgram(gpu::Device& device, const char* name, std::span<const uint32_t> fragment,
                         VkCompareOp depthCompare, bool depthWrite) {
  gpu::RasterState state;
  state.colors = {{kSmoothedFormat}};
  state.depthFormat = kMarkFormat;
  state.depthCompare = depthCompare;
  state.depthWrite = depthWrite;
  return gpu::createRasterProgram(device, name, shaders::techniques_whole_picture_vert, fragment, state);
}

}  // namespace

EdgeSmoothing::EdgeSmoothing(gpu::Device& device)
    : device_(device),
      marking_(edgeProgram(device, "mark edges", shaders::viewer_show_mark_edges_frag, VK_COMPARE_OP_ALWAYS,
                           true)),
      smoothing_(edgeProgram(device, "smooth edges", shaders::viewer_show_smooth_edges_frag,
                             VK_COMPARE_OP_LESS, false)),
      sampler_(gpu::createSampler(device)) {}

const gpu::Image& EdgeSmoothing::smooth(const gpu::Image& picture, std::vector<PassTime>& passes) {
  const gpu::ImageOptions& options = picture.options();
  if (!smoothed_ || smoothed_.width() != options.width || smoothed_.height() != options.height) {
    smoothed_ =
        gpu::createImage(device_, "smoothed picture",
                         {.format = kSmoothedFormat, .width = options.width, .height = options.height});
    marks_ = gpu::createImage(device_, "marks of edges",
                              {.format = kMarkFormat, .width = options.width, .height = options.height});
  }
  const auto draw = [&](gpu::CommandList& commands, const gpu::Program& program) {
    commands.render(
        {.colors = {{&smoothed_, 0, std::nullopt}}, .depth = gpu::DepthAttachment{&marks_, 0, std::nullopt}},
        [&] {
          commands.draw(program, 3, 1, gpu::NoConstants{}, {{"picture", picture, sampler_}});
        });
  };
  const std::vector<PassTime> times = device_.submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("smooth edges", [&] {
      draw(commands, marking_);
      commands.barrier();
      draw(commands, smoothing_);
    });
  });
  passes.insert(passes.end(), times.begin(), times.end());
  return smoothed_;
}

}  // namespace nephroid
