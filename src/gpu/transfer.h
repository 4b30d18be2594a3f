// Whole buffers and images between host and device, each waited for: for setting up and reading results.
#pragma once

#include "gpu/command_list.h"

namespace nephroid::gpu {

Buffer uploadBytes(Device& device, const std::string& name, std::span<const std::byte> bytes);
void downloadBytes(Device& device, const Buffer& from, std::span<std::byte> to);
void downloadBytes(Device& device, const Image& from, uint32_t layer, std::span<std::byte> to);

// A device-local buffer with these contents.
template <class T>
Buffer upload(Device& device, const std::string& name, const std::vector<T>& values) {
  return uploadBytes(device, name, std::as_bytes(std::span(values)));
}

// The texels of each mip level of layer 0, rows from the top.
void uploadImage(Device& device, const Image& to, const std::vector<std::vector<std::byte>>& levels);

template <class T>
std::vector<T> download(Device& device, const Buffer& from) {
  std::vector<T> values(from.size() / sizeof(T));
  downloadBytes(device, from, std::as_writable_bytes(std::span(values)));
  return values;
}

// Level 0 of a layer, T being the texel, rows from the top.
template <class T>
std::vector<T> download(Device& device, const Image& from, uint32_t layer = 0) {
  std::vector<T> texels(std::size_t{from.width()} * from.height());
  downloadBytes(device, from, layer, std::as_writable_bytes(std::span(texels)));
  return texels;
}

}  // namespace nephroid::gpu
