#include "core/image.h"

#include <algorithm>

namespace nephroid {

std::vector<float>& Image::channel(std::string_view name) {
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const ImageChannel& channel) { return channel.name == name; });
  if (found != channels.end()) return found->values;
  return channels.emplace_back(ImageChannel{std::string(name), std::vector<float>(pixelCount())}).values;
}

const std::vector<float>* Image::find(std::string_view name) const {
  for (const ImageChannel& channel : channels)
    if (channel.name == name) return &channel.values;
  return nullptr;
}

}  // namespace nephroid
