#include "gpu/program.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <deque>
#include <iterator>
#include <stdexcept>

namespace nephroid::gpu {
namespace {

// A shader module that lives as long as its pipeline is being made.
class ShaderModule {
 public:
  ShaderModule(VkDevice device, std::span<const uint32_t> spirv, const std::string& name) : device_(device) {
    auto info = structure<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = spirv.size_bytes();
    info.pCode = spirv.data();
    check(vkCreateShaderModule(device, &info, nullptr, &handle_), "loading shader " + name);
  }
  ~ShaderModule() { vkDestroyShaderModule(device_, handle_, nullptr); }
  ShaderModule(const ShaderModule&) = delete;
  ShaderModule& operator=(const ShaderModule&) = delete;

  VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits stage,
                                        const VkSpecializationInfo& constants) const {
    auto info =
        structure<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    info.stage = stage;
    info.module = handle_;
    info.pName = "main";
    info.pSpecializationInfo = &constants;
    return info;
  }

 private:
  VkDevice device_;
  VkShaderModule handle_ = VK_NULL_HANDLE;
};

// Values of a shader's specialization constants; of `groupSize` (threads) that of the one which is its
// group's size.
class Specialization {
 public:
  Specialization(const Reflection& shader, const std::vector<SpecializationConstant>& constants,
                 uint32_t groupSize = 0) {
    for (const SpecializationConstant& constant : constants) {
      const auto found = std::ranges::find(shader.constants, constant.name, &ReflectedConstant::name);
      if (found != shader.constants.end()) add(found->id, constant.value);
    }
    if (shader.subgroupSizeId) add(*shader.subgroupSizeId, groupSize);
    info_.mapEntryCount = static_cast<uint32_t>(entries_.size());
    info_.pMapEntries = entries_.data();
    info_.dataSize = values_.size() * sizeof(uint32_t);
    info_.pData = values_.data();
  }
  Specialization(const Specialization&) = delete;
  Specialization& operator=(const Specialization&) = delete;
  const VkSpecializationInfo& info() const { return info_; }

 private:
  void add(uint32_t id, uint32_t value) {
    entries_.push_back({id, static_cast<uint32_t>(values_.size() * sizeof(uint32_t)), sizeof(uint32_t)});
    values_.push_back(value);
  }

  std::vector<VkSpecializationMapEntry> entries_;
  std::vector<uint32_t> values_;
  VkSpecializationInfo info_{};
};

void expectKnown(const Program& program, const std::vector<SpecializationConstant>& constants) {
  for (const SpecializationConstant& constant : constants)
    if (std::ranges::find(program.reflection().constants, constant.name, &ReflectedConstant::name) ==
        program.reflection().constants.end())
      throw std::logic_error("program " + program.name() + " has no constant \"" +
                             std::string(constant.name) + "\"");
}

VkPipelineColorBlendAttachmentState blendState(Blend blend) {
  VkPipelineColorBlendAttachmentState state{};
  state.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                         VK_COLOR_COMPONENT_A_BIT;
  state.blendEnable = blend != Blend::none;
  state.srcColorBlendFactor = blend == Blend::over ? VK_BLEND_FACTOR_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
  state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  state.dstColorBlendFactor = state.dstAlphaBlendFactor =
      blend == Blend::over ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
  state.colorBlendOp = state.alphaBlendOp = VK_BLEND_OP_ADD;
  return state;
}

VkPipeline createRasterPipeline(Device& device, const Program& program, const RasterState& state,
                                std::span<const VkPipelineShaderStageCreateInfo> stages) {
  const auto vertexInput = structure<VkPipelineVertexInputStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
  auto assembly = structure<VkPipelineInputAssemblyStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
  assembly.topology = state.topology;
  auto viewport =
      structure<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
  viewport.viewportCount = viewport.scissorCount = 1;
  auto raster = structure<VkPipelineRasterizationStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
  raster.cullMode = state.cull;
  raster.frontFace = state.frontFace;
  raster.depthBiasEnable = state.depthBiasConstant != 0 || state.depthBiasSlope != 0;
  raster.depthBiasConstantFactor = state.depthBiasConstant;
  raster.depthBiasSlopeFactor = state.depthBiasSlope;
  raster.lineWidth = 1;
  auto multisample = structure<VkPipelineMultisampleStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
  multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  auto depth = structure<VkPipelineDepthStencilStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
  depth.depthTestEnable = state.depthFormat != VK_FORMAT_UNDEFINED;
  depth.depthWriteEnable = depth.depthTestEnable && state.depthWrite;
  depth.depthCompareOp = state.depthCompare;

  std::vector<VkFormat> formats;
  std::vector<VkPipelineColorBlendAttachmentState> blends;
  for (const ColorTarget& target : state.colors) {
    formats.push_back(target.format);
    blends.push_back(blendState(target.blend));
  }
  auto blend = structure<VkPipelineColorBlendStateCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
  blend.attachmentCount = static_cast<uint32_t>(blends.size());
  blend.pAttachments = blends.data();
  const std::array dynamics{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  auto dynamic =
      structure<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
  dynamic.dynamicStateCount = static_cast<uint32_t>(dynamics.size());
  dynamic.pDynamicStates = dynamics.data();
  auto rendering = structure<VkPipelineRenderingCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
  rendering.colorAttachmentCount = static_cast<uint32_t>(formats.size());
  rendering.pColorAttachmentFormats = formats.data();
  rendering.depthAttachmentFormat = state.depthFormat;

  auto info = structure<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
  info.pNext = &rendering;
  info.stageCount = static_cast<uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &vertexInput;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &multisample;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = program.layout();
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateGraphicsPipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
        "making program " + program.name());
  return pipeline;
}

}  // namespace

// A shader as a program uses it: with the binding numbers of that program.
struct ShaderStage {
  ShaderStage(VkShaderStageFlagBits kind_, const std::string& name, std::span<const uint32_t> shader)
      : kind(kind_), spirv(shader.begin(), shader.end()), reflection(reflect(name, shader)) {}
  VkShaderStageFlagBits kind;
  std::vector<uint32_t> spirv;
  Reflection reflection;
};

Program::~Program() {
  if (!device_) return;
  vkDestroyPipeline(device_->handle(), pipeline_, nullptr);
  vkDestroyPipelineLayout(device_->handle(), layout_, nullptr);
  vkDestroyDescriptorSetLayout(device_->handle(), setLayout_, nullptr);
}

void Program::swap(Program& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(pipeline_, other.pipeline_);
  std::swap(layout_, other.layout_);
  std::swap(setLayout_, other.setLayout_);
  std::swap(bindPoint_, other.bindPoint_);
  std::swap(stages_, other.stages_);
  std::swap(reflection_, other.reflection_);
  std::swap(name_, other.name_);
}

// Numbers the images of a stage: one that an earlier stage has too is the same image.
void Program::add(ShaderStage& stage) {
  stages_ |= stage.kind;
  reflection_.pushConstantBytes = std::max(reflection_.pushConstantBytes, stage.reflection.pushConstantBytes);
  reflection_.localSize = stage.reflection.localSize;
  std::ranges::copy(stage.reflection.constants, std::back_inserter(reflection_.constants));
  std::vector<ReflectedBinding>& all = reflection_.bindings;
  for (const ReflectedBinding& binding : stage.reflection.bindings) {
    const auto known = std::ranges::find(all, binding.hash, &ReflectedBinding::hash);
    const auto number = static_cast<uint32_t>(known - all.begin());
    if (known == all.end())
      all.push_back(binding);
    else if (known->type != binding.type || known->isLayered != binding.isLayered ||
             known->count != binding.count)
      throw std::logic_error("program " + name_ + ": its shaders declare \"" + binding.name +
                             "\" as images of different kinds");
    stage.spirv[binding.numberAt] = number;
  }
}

void Program::createLayout() {
  if (reflection_.pushConstantBytes > device_->limits().maxPushConstantsSize)
    throw std::logic_error("program " + name_ + " has more push constants than the device takes");
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const ReflectedBinding& binding : reflection_.bindings)
    bindings.push_back(
        {static_cast<uint32_t>(bindings.size()), binding.type, binding.count, stages_, nullptr});
  auto set = structure<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
  set.bindingCount = static_cast<uint32_t>(bindings.size());
  set.pBindings = bindings.data();
  check(vkCreateDescriptorSetLayout(device_->handle(), &set, nullptr, &setLayout_),
        "laying out program " + name_);

  const VkPushConstantRange range{stages_, 0, (reflection_.pushConstantBytes + 3) / 4 * 4};
  auto layout = structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &setLayout_;
  layout.pushConstantRangeCount = range.size > 0 ? 1 : 0;
  layout.pPushConstantRanges = &range;
  check(vkCreatePipelineLayout(device_->handle(), &layout, nullptr, &layout_), "laying out program " + name_);
}

Program createComputeProgram(Device& device, const std::string& name, std::span<const uint32_t> spirv,
                             const std::vector<SpecializationConstant>& constants) {
  Program program;
  program.device_ = &device;
  program.name_ = name;
  ShaderStage shader(VK_SHADER_STAGE_COMPUTE_BIT, name, spirv);
  program.add(shader);
  expectKnown(program, constants);
  program.createLayout();
  auto size = structure<VkPipelineShaderStageRequiredSubgroupSizeCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO);
  size.requiredSubgroupSize = device.subgroupSize();
  const std::optional<uint32_t> sizeId = shader.reflection.subgroupSizeId;
  if (sizeId) program.reflection_.localSize[0] = device.subgroupSize();
  const ShaderModule module(device.handle(), shader.spirv, name);
  const Specialization specialization(shader.reflection, constants, device.subgroupSize());
  auto info = structure<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  info.stage = module.stage(VK_SHADER_STAGE_COMPUTE_BIT, specialization.info());
  if (sizeId) {
    info.stage.pNext = &size;
    info.stage.flags = VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT;
  }
  info.layout = program.layout_;
  check(vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &program.pipeline_),
        "making program " + name);
  device.setName(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(program.pipeline_), name);
  return program;
}

Program createRasterProgram(Device& device, const std::string& name, std::span<const uint32_t> vertex,
                            std::span<const uint32_t> fragment, const RasterState& state,
                            const std::vector<SpecializationConstant>& constants) {
  Program program;
  program.device_ = &device;
  program.name_ = name;
  program.bindPoint_ = VK_PIPELINE_BIND_POINT_GRAPHICS;
  std::vector<ShaderStage> shaders{{VK_SHADER_STAGE_VERTEX_BIT, name, vertex}};
  if (!fragment.empty()) shaders.emplace_back(VK_SHADER_STAGE_FRAGMENT_BIT, name, fragment);
  for (ShaderStage& shader : shaders) program.add(shader);
  expectKnown(program, constants);
  program.createLayout();
  std::deque<ShaderModule> modules;
  std::deque<Specialization> specializations;
  std::vector<VkPipelineShaderStageCreateInfo> stages;
  for (const ShaderStage& shader : shaders)
    stages.push_back(
        modules.emplace_back(device.handle(), shader.spirv, name)
            .stage(shader.kind, specializations.emplace_back(shader.reflection, constants).info()));
  program.pipeline_ = createRasterPipeline(device, program, state, stages);
  device.setName(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(program.pipeline_), name);
  return program;
}

}  // namespace nephroid::gpu
