// Copies whole buffers and images between host and device, and waits for each copy. Used for setup and for
// results.
#pragma once

#include "core/image.h"
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

// `levels`: for each mip level the texels of layer 0, row by row from the top.
void uploadImage(Device& device, const Image& to, const std::vector<std::vector<std::byte>>& levels);

template <class T>
std::vector<T> download(Device& device, const Buffer& from) {
  std::vector<T> values(from.size() / sizeof(T));
  downloadBytes(device, from, std::as_writable_bytes(std::span(values)));
  return values;
}

// The texels (of type T) of level 0 of a layer, row by row from the top.
template <class T>
std::vector<T> download(Device& device, const Image& from, uint32_t layer = 0) {
  std::vector<T> texels(std::size_t{from.width()} * from.height());
  downloadBytes(device, from, layer, std::as_writable_bytes(std::span(texels)));
  return texels;
}

// An rgba8 image without its alpha.
ByteImage downloadPicture(Device& device, const Image& from);

}  // namespace nephroid::gpu
