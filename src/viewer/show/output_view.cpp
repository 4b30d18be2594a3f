#include "viewer/show/output_view.h"

#include <cmath>

#include "gpu/command_list.h"
#include "shaders/techniques/whole_picture_vert.h"
#include "shaders/viewer/show/layers_frag.h"
#include "shaders/viewer/show/plain_frag.h"
#include "shaders/viewer/show/words_frag.h"
#include "techniques/show_data.h"

namespace nephroid {
namespace {

constexpr VkFormat kBytes = VK_FORMAT_R8G8B8A8_UNORM;

gpu::Program program(gpu::Device& device, std::span<const uint32_t> fragment) {
  return gpu::createRasterProgram(device, "output of a pass", shaders::techniques_whole_picture_vert,
                                  fragment, {.colors = {{kBytes}}});
}

// So that the layers' cells are nearly as wide as the layers are.
uint32_t columnsFor(uint32_t layers, uvec2 size, uvec2 layer) {
  const float aspect = float(size.x) / float(size.y) * float(layer.y) / float(layer.x);
  const float columns = std::round(std::sqrt(float(layers) * aspect));
  return glm::clamp(static_cast<uint32_t>(columns), 1u, layers);
}

}  // namespace

OutputView::OutputView(gpu::Device& device)
    : device_(device),
      plain_(program(device, shaders::viewer_show_plain_frag)),
      layers_(program(device, shaders::viewer_show_layers_frag)),
      words_(program(device, shaders::viewer_show_words_frag)) {}

const gpu::Image& OutputView::show(const PassOutput& output, uvec2 size) {
  if (!picture_ || uvec2(picture_.width(), picture_.height()) != size)
    picture_ =
        gpu::createImage(device_, "output of a pass", {.format = kBytes, .width = size.x, .height = size.y});
  const gpu::Image& image = *output.image;
  const uvec2 from(image.width(), image.height());
  const ShowConstants constants{
      ivec2(size),        ivec2(from),    columnsFor(image.layerCount(), size, from),
      image.layerCount(), output.meaning, output.scale};
  const bool isWords = image.format() == VK_FORMAT_R32_UINT;
  const gpu::Program& chosen = isWords ? words_ : image.isArray() ? layers_ : plain_;
  device_.submitAndWait([&](gpu::CommandList& commands) {
    commands.pass("output of a pass", [&] {
      commands.render({.colors = {{&picture_, 0, vec4(0)}}}, [&] {
        commands.draw(chosen, 3, 1, constants, {{"image", image}});
      });
    });
  });
  return picture_;
}

}  // namespace nephroid
