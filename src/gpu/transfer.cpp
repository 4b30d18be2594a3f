#include "gpu/transfer.h"

#include <algorithm>
#include <array>

namespace nephroid::gpu {

Buffer uploadBytes(Device& device, const std::string& name, std::span<const std::byte> bytes) {
  Buffer buffer = createBuffer(device, name, bytes.size());
  const Buffer staging = createBuffer(device, name + " staging", bytes.size(), MemoryKind::upload);
  staging.writeBytes(bytes, 0);
  device.submitAndWait([&](CommandList& commands) { commands.copy(staging, buffer, bytes.size()); });
  return buffer;
}

void uploadImage(Device& device, const Image& to, const std::vector<std::vector<std::byte>>& levels) {
  std::vector<std::byte> all;
  std::vector<VkDeviceSize> offsets;
  for (const auto& level : levels) {
    all.resize((all.size() + 15) / 16 * 16);  // a copy begins at a multiple of the texel's size
    offsets.push_back(all.size());
    all.insert(all.end(), level.begin(), level.end());
  }
  const Buffer staging = createBuffer(device, to.name() + " staging", all.size(), MemoryKind::upload);
  staging.writeBytes(all, 0);
  device.submitAndWait([&](CommandList& commands) {
    for (uint32_t level = 0; level < levels.size(); ++level)
      commands.copy(staging, offsets[level], to, 0, level);
  });
}

namespace {

void readStaging(const Buffer& staging, std::span<std::byte> to) {
  std::copy_n(staging.mapped(), to.size(), to.begin());
}

}  // namespace

void downloadBytes(Device& device, const Buffer& from, std::span<std::byte> to) {
  const Buffer staging = createBuffer(device, from.name() + " readback", to.size(), MemoryKind::readback);
  device.submitAndWait([&](CommandList& commands) { commands.copy(from, staging, to.size()); });
  readStaging(staging, to);
}

void downloadBytes(Device& device, const Image& from, uint32_t layer, std::span<std::byte> to) {
  const Buffer staging = createBuffer(device, from.name() + " readback", to.size(), MemoryKind::readback);
  device.submitAndWait([&](CommandList& commands) { commands.copy(from, layer, staging); });
  readStaging(staging, to);
}

ByteImage downloadPicture(Device& device, const Image& from) {
  ByteImage picture{from.width(), from.height(), 3, {}};
  const auto texels = download<std::array<uint8_t, 4>>(device, from);
  picture.bytes.reserve(3 * texels.size());
  for (const auto& texel : texels)
    picture.bytes.insert(picture.bytes.end(), texel.begin(), texel.begin() + 3);
  return picture;
}

}  // namespace nephroid::gpu
