#include "render/shadows/lamp_shadows.h"

#include <algorithm>
#include <utility>

namespace nephroid {

void LampShadows::resize(uvec2 picture) {
  picture_ = picture;
  for (View& view : views_) view.seen.resize(picture);
}

void LampShadows::update(const Scene& scene, const std::vector<MeshExtent>& extents) {
  lamps_ = shadowedLamps(scene, extents);
  isAny_ = std::ranges::any_of(lamps_, [](const ShadowedLamp& lamp) { return !lamp.boxes.empty(); });
}

void LampShadows::forget() {
  for (View& view : views_) view.seen.forget();
}

void LampShadows::recordPoints(gpu::CommandList& commands, uint32_t view, const ReceiverPoints& points) {
  View& to = views_[view];
  const VkDeviceSize bytes = sizeof(vec4) * points.position->width() * points.position->height();
  gpu::ensureBuffer(device_, to.positions, "positions of points", bytes, gpu::MemoryKind::readback);
  gpu::ensureBuffer(device_, to.normals, "normals of points", bytes, gpu::MemoryKind::readback);
  commands.copy(*points.position, 0, to.positions);
  commands.copy(*points.normal, 0, to.normals);
}

void LampShadows::look(uint32_t view, const RayScene& rays, const SampleOfMany& sample) {
  const View& from = views_[view];
  const std::size_t pixels = std::size_t(picture_.x) * picture_.y;
  look(view, rays, sample,
       {from.positions.as<vec4>().first(pixels), from.normals.as<vec4>().first(pixels), uvec2(0), picture_},
       picture_.x);
}

void LampShadows::look(uint32_t view, const RayScene& rays, const SampleOfMany& sample,
                       const ViewPoints& points, uint32_t width) {
  View& to = views_[view];
  to.size = {width, uint32_t(points.positions.size()) / width};
  to.seen.look(rays, lamps_, points, sample);
  store(to);
}

// Puts what was seen where the device finds it.
void LampShadows::store(View& view) {
  view.isNew = true;
  view.parts.resize(lamps_.size());
  const VkDeviceSize pitch = VkDeviceSize(view.size.x) * view.size.y;
  gpu::ensureBuffer(device_, view.staging, "seen parts of lamps", (pitch + 4) * lamps_.size(),
                    gpu::MemoryKind::upload);
  for (uint32_t lamp = 0; lamp < lamps_.size(); ++lamp) {
    if (!hasShadows(lamp)) continue;
    gpu::Image& image = view.parts[lamp];
    if (!image || image.width() != view.size.x || image.height() < view.size.y)
      image = gpu::createImage(device_, "seen part of a lamp",
                               {.format = VK_FORMAT_R8_UNORM, .width = view.size.x, .height = view.size.y});
    view.staging.writeBytes(std::as_bytes(view.seen.parts(lamp)), lamp * ((pitch + 3) / 4 * 4));
  }
}

void LampShadows::recordParts(gpu::CommandList& commands) {
  for (View& view : views_) {
    if (!std::exchange(view.isNew, false)) continue;
    const VkDeviceSize pitch = (VkDeviceSize(view.size.x) * view.size.y + 3) / 4 * 4;
    for (uint32_t lamp = 0; lamp < lamps_.size(); ++lamp)
      if (hasShadows(lamp))
        commands.copy(view.staging, lamp * pitch, view.parts[lamp], gpu::Region{{0, 0}, view.size});
  }
}

}  // namespace nephroid
