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

EdgeSmoothing::EdgeSmoothing(gpu::Device& device, uvec2 size)
    : device_(device),
      marking_(edgeProgram(device, "mark edges", shaders::viewer_show_mark_edges_frag, VK_COMPARE_OP_ALWAYS,
                           true)),
      smoothing_(edgeProgram(device, "smooth edges", shaders::viewer_show_smooth_edges_frag,
                             VK_COMPARE_OP_LESS, false)),
      sampler_(gpu::createSampler(device)) {
  resize(size);
}

void EdgeSmoothing::resize(uvec2 size) {
  const auto image = [&](const char* name, VkFormat format) {
    return gpu::createImage(device_, name, {.format = format, .width = size.x, .height = size.y});
  };
  smoothed_ = image("smoothed picture", kSmoothedFormat);
  marks_ = image("marks of edges", kMarkFormat);
  device_.submitAndWait([&](gpu::CommandList& commands) { commands.clear(smoothed_, vec4(0, 0, 0, 1)); });
}

void EdgeSmoothing::smooth(const gpu::Image& picture, std::vector<PassTime>& passes) {
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
}

}  // namespace nephroid
