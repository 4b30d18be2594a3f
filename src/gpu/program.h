// Compute and raster pipelines. Their inputs are found by reflection of the shaders. Images are bound by the
// names that they have in the shaders (push descriptors); the same name is the same image in all stages of a
// program, and binding numbers are chosen here. All other data is in push constants (at most 128 bytes),
// which hold the addresses of buffers.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu/device.h"
#include "gpu/reflection.h"

namespace nephroid::gpu {

// The value of a specialization constant, by its name in the program's shaders. Constants that are not given
// keep the shader's value.
struct SpecializationConstant {
  std::string_view name;
  uint32_t value = 0;  // the 32 bits of the value, of any type
};

// none: replaces what is there. add: adds to it. over: covers it by the source's alpha.
enum class Blend { none, add, over };

struct ColorTarget {
  VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
  Blend blend = Blend::none;
};

struct RasterState {
  std::vector<ColorTarget> colors;
  VkFormat depthFormat = VK_FORMAT_UNDEFINED;  // undefined: no depth attachment
  VkCompareOp depthCompare = VK_COMPARE_OP_LESS;
  bool depthWrite = true;
  VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkCullModeFlags cull = VK_CULL_MODE_NONE;
  VkFrontFace frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;  // as seen with y down
  float depthBiasConstant = 0;
  float depthBiasSlope = 0;
};

struct ShaderStage;

class Program {
 public:
  Program() = default;
  Program(Program&& other) noexcept { swap(other); }
  Program& operator=(Program&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Program();

  VkPipeline pipeline() const { return pipeline_; }
  VkPipelineLayout layout() const { return layout_; }
  VkPipelineBindPoint bindPoint() const { return bindPoint_; }
  VkShaderStageFlags stages() const { return stages_; }
  // The inputs of all stages. A binding's index in the list is its binding number.
  const Reflection& reflection() const { return reflection_; }
  const std::string& name() const { return name_; }
  explicit operator bool() const { return pipeline_ != VK_NULL_HANDLE; }

 private:
  friend Program createComputeProgram(Device&, const std::string&, std::span<const uint32_t>,
                                      const std::vector<SpecializationConstant>&);
  friend Program createRasterProgram(Device&, const std::string&, std::span<const uint32_t>,
                                     std::span<const uint32_t>, const RasterState&,
                                     const std::vector<SpecializationConstant>&);
  void add(ShaderStage& stage);
  void createLayout();
  void swap(Program& other) noexcept;

  Device* device_ = nullptr;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkPipelineBindPoint bindPoint_ = VK_PIPELINE_BIND_POINT_COMPUTE;
  VkShaderStageFlags stages_ = 0;
  Reflection reflection_;
  std::string name_;
};

// Both functions throw std::logic_error for a constant that no shader has, and for an image that two shaders
// declare differently.
//
// In a shader with `layout(local_size_x_id = N) in`, each group is one full subgroup of Device::subgroupSize
// threads: the constant N is set here. Shaders in which subgroups take different branches need this. SPIR-V
// guarantees that threads meet again after a branch only where the whole group entered it, and in some
// drivers subgroupBarrier waits for the whole group.
Program createComputeProgram(Device& device, const std::string& name, std::span<const uint32_t> spirv,
                             const std::vector<SpecializationConstant>& constants = {});

// With an empty `fragment` only depth is drawn.
Program createRasterProgram(Device& device, const std::string& name, std::span<const uint32_t> vertex,
                            std::span<const uint32_t> fragment, const RasterState& state,
                            const std::vector<SpecializationConstant>& constants = {});

}  // namespace nephroid::gpu
