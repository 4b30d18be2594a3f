// Records the commands of one Device::submitAndWait. Commands within a pass run in any order. `pass` sets a
// full barrier before the pass, and `barrier` sets one within it. Mistakes of the caller (wrong constants or
// images) throw std::logic_error in every build.
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/shared_language.h"
#include "gpu/program.h"
#include "gpu/resources.h"

namespace nephroid::gpu {

// The name of an image in a shader. Its hash is computed when C++ is compiled, so that only numbers are
// compared while a frame is recorded.
struct ImageName {
  consteval ImageName(const char* text_) : text(text_), hash(hashOfName(text_)) {}
  const char* text;
  uint64_t hash;
};

// The image, or the images of an array (`texture2D name[3]`), for the binding of that name. `sampler2D` needs
// a sampler too; `image2D` and `texture2D` need none.
struct Binding {
  Binding(ImageName name_, const Image& image) : name(name_), images{&image} {}
  Binding(ImageName name_, const Image& image, const Sampler& sampler_)
      : name(name_), images{&image}, sampler(&sampler_) {}
  Binding(ImageName name_, std::vector<const Image*> images_) : name(name_), images(std::move(images_)) {}
  ImageName name;
  std::vector<const Image*> images;
  const Sampler* sampler = nullptr;
};
// All bindings of a program, each once, in any order.
using Bindings = std::initializer_list<Binding>;

struct NoConstants {};

struct ColorAttachment {
  const Image* image = nullptr;
  uint32_t layer = 0;
  std::optional<vec4> clear;  // without it the contents are kept
};

struct DepthAttachment {
  const Image* image = nullptr;
  uint32_t layer = 0;
  std::optional<float> clear;
};

// A rectangle of texels.
struct Region {
  ivec2 corner{0};
  uvec2 size{0};
};

struct RenderTargets {
  std::vector<ColorAttachment> colors;
  std::optional<DepthAttachment> depth;
  std::optional<Region> region{};  // the part of the targets that is cleared and drawn to; without it, all
};

// Indices (uint32) `first` .. `first + count` of a buffer, each with `vertexOffset` added to it.
struct IndexRange {
  uint32_t first = 0;
  uint32_t count = 0;
  int32_t vertexOffset = 0;
};

class CommandList {
 public:
  static constexpr uint32_t kMaxTimedPasses = 256;

  CommandList(Device& device, VkCommandBuffer commandBuffer, VkQueryPool timestamps);

  // A named and timed pass. It sees the results of all commands before it. Passes may be nested.
  void pass(const std::string& name, const std::function<void()>& record);

  // All commands after this see the results of all commands before it.
  void barrier();

  // Starts at least `threads` threads, in whole groups. Threads beyond `threads` must return early in the
  // shader.
  template <class Constants>
  void dispatch(const Program& program, uvec3 threads, const Constants& constants, Bindings bindings = {}) {
    dispatchBytes(program, threads, bytesOf(constants), bindings);
  }

  // `draws` records the draws to these targets. The viewport is the whole targets, even with a region.
  void render(const RenderTargets& targets, const std::function<void()>& draws);

  template <class Constants>
  void draw(const Program& program, uint32_t vertexCount, uint32_t instanceCount, const Constants& constants,
            Bindings bindings = {}) {
    drawBytes(program, vertexCount, instanceCount, bytesOf(constants), bindings);
  }
  template <class Constants>
  void drawIndexed(const Program& program, const Buffer& indices, const IndexRange& range,
                   uint32_t instanceCount, const Constants& constants, Bindings bindings = {}) {
    drawIndexedBytes(program, indices, range, instanceCount, bytesOf(constants), bindings);
  }

  // Draws as the VkDrawIndirectCommand at the beginning of `command` tells.
  template <class Constants>
  void drawIndirect(const Program& program, const Buffer& command, const Constants& constants,
                    Bindings bindings = {}) {
    drawIndirectBytes(program, command, bytesOf(constants), bindings);
  }

  void clear(const Image& image, vec4 color);
  void fill(const Buffer& buffer, uint32_t word);
  void copy(const Buffer& from, const Buffer& to, VkDeviceSize bytes, VkDeviceSize fromOffset = 0,
            VkDeviceSize toOffset = 0);
  void copy(const Buffer& from, VkDeviceSize fromOffset, const Image& to, uint32_t layer = 0,
            uint32_t mipLevel = 0);
  // The texels of a region, row by row without gaps.
  void copy(const Buffer& from, VkDeviceSize fromOffset, const Image& to, const Region& region);
  void copy(const Image& from, uint32_t layer, const Buffer& to, VkDeviceSize toOffset = 0);

  VkCommandBuffer handle() const { return commandBuffer_; }
  const std::vector<std::string>& timedPasses() const { return timedPasses_; }

  void toGeneralLayout(const Image& image);  // for createImage
  void makeVisibleToHost();                  // for submitAndWait

 private:
  template <class Constants>
  static std::span<const std::byte> bytesOf(const Constants& constants) {
    static_assert(std::is_trivially_copyable_v<Constants>);
    if constexpr (std::is_empty_v<Constants>)
      return {};
    else
      return std::as_bytes(std::span(&constants, 1));
  }
  void dispatchBytes(const Program& program, uvec3 threads, std::span<const std::byte> constants,
                     Bindings bindings);
  void drawBytes(const Program& program, uint32_t vertexCount, uint32_t instanceCount,
                 std::span<const std::byte> constants, Bindings bindings);
  void drawIndexedBytes(const Program& program, const Buffer& indices, const IndexRange& range,
                        uint32_t instanceCount, std::span<const std::byte> constants, Bindings bindings);
  void drawIndirectBytes(const Program& program, const Buffer& command, std::span<const std::byte> constants,
                         Bindings bindings);
  void bind(const Program& program, std::span<const std::byte> constants, Bindings bindings);
  void writeTimestamp(uint32_t query);

  Device& device_;
  VkCommandBuffer commandBuffer_;
  VkQueryPool timestamps_;
  std::vector<std::string> timedPasses_;
};

}  // namespace nephroid::gpu
