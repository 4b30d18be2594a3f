#include "graphics.h"

#include "gpu/transfer.h"

namespace nephroid {
namespace {

// Makes `image` anew where it is not of this size.
void ensureImage(gpu::Device& device, gpu::Image& image, const char* name, uvec2 size) {
  if (image && uvec2(image.width(), image.height()) == size) return;
  image =
      gpu::createImage(device, name, {.format = VK_FORMAT_R8G8B8A8_UNORM, .width = size.x, .height = size.y});
}

}  // namespace

Graphics::Graphics(DesktopWindow& window, const ViewerOptions& options)
    : device_({.device = options.device, .surfaceExtensions = DesktopWindow::surfaceExtensions()}),
      swapchain_(device_, window.createSurface(device_.instance()),
                 options.frames > 0 ? gpu::Pace::none : gpu::Pace::screen),
      gui_(device_, window),
      outputView_(std::make_unique<OutputView>(device_)) {}

void Graphics::show(uvec2 framebufferSize) {
  ensureImage(device_, screen_, "screen", framebufferSize);
  gui_.draw(screen_);
  swapchain_.show(screen_, framebufferSize);
}

ByteImage Graphics::screenPicture() {
  return gpu::downloadPicture(device_, screen_);
}

void Graphics::remakePrograms() {
  auto outputs = std::make_unique<OutputView>(device_);
  if (stage) stage->remake();
  outputView_ = std::move(outputs);
}

void Graphics::upload(const ByteImage& picture) {
  ensureImage(device_, uploaded_, "picture of the host", {picture.width, picture.height});
  std::vector<std::byte> texels;
  texels.reserve(picture.bytes.size() / 3 * 4);
  for (std::size_t i = 0; i + 2 < picture.bytes.size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c) texels.push_back(std::byte{picture.bytes[i + c]});
    texels.push_back(std::byte{255});
  }
  gpu::uploadImage(device_, uploaded_, {texels});
}

}  // namespace nephroid
