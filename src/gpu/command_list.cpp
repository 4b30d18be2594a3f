#include "gpu/command_list.h"

#include <algorithm>
#include <stdexcept>

namespace nephroid::gpu {
namespace {

constexpr VkAccessFlags2 kAnyAccess = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;

[[noreturn]] void refuse(const Program& program, const std::string& why) {
  throw std::logic_error("program " + program.name() + " " + why);
}

std::string inQuotes(std::string_view name) {
  return '"' + std::string(name) + '"';
}

void memoryBarrier(VkCommandBuffer commands, VkPipelineStageFlags2 toStage, VkAccessFlags2 toAccess) {
  auto memory = structure<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
  memory.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  memory.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  memory.dstStageMask = toStage;
  memory.dstAccessMask = toAccess;
  auto dependency = structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &memory;
  vkCmdPipelineBarrier2(commands, &dependency);
}

VkBufferImageCopy regionOf(const Image& image, uint32_t layer, uint32_t mipLevel, VkDeviceSize bufferOffset) {
  VkBufferImageCopy region{};
  region.bufferOffset = bufferOffset;
  region.imageSubresource = {image.aspect(), mipLevel, layer, 1};
  region.imageExtent = {std::max(image.width() >> mipLevel, 1u), std::max(image.height() >> mipLevel, 1u), 1};
  return region;
}

VkRenderingAttachmentInfo attachment(const Image& image, uint32_t layer,
                                     const std::optional<VkClearValue>& clear) {
  auto info = structure<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
  info.imageView = image.layerView(layer);
  info.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
  info.loadOp = clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
  info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  if (clear) info.clearValue = *clear;
  return info;
}

VkClearValue clearValue(vec4 color) {
  VkClearValue value{};
  for (int i = 0; i < 4; ++i) value.color.float32[i] = color[i];
  return value;
}

VkDescriptorImageInfo imageInfo(const Program& program, const ReflectedBinding& wanted, const Binding& given,
                                const Image& image) {
  const bool isStorage = wanted.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
  const VkImageUsageFlags usage = isStorage ? VK_IMAGE_USAGE_STORAGE_BIT : VK_IMAGE_USAGE_SAMPLED_BIT;
  const auto refuseIt = [&](const char* why) {
    refuse(program, "given image " + inQuotes(image.name()) + " for " + inQuotes(wanted.name) + ": " + why);
  };
  if (wanted.isLayered != image.isArray()) refuseIt("one has layers, the other not");
  if ((image.usage() & usage) == 0) refuseIt("its format cannot be used so here");
  return {given.sampler ? given.sampler->handle() : VK_NULL_HANDLE,
          isStorage ? image.storageView() : image.view(), VK_IMAGE_LAYOUT_GENERAL};
}

uint64_t hashOf(const Binding& binding) {
  return binding.name.hash;
}

// What is given besides all that the program has.
void refuseOthers(const Program& program, Bindings bindings) {
  for (const Binding& given : bindings) {
    const std::string name = inQuotes(given.name.text);
    if (std::ranges::count(program.reflection().bindings, given.name.hash, &ReflectedBinding::hash) == 0)
      refuse(program, "has no image " + name);
    if (std::ranges::count(bindings, given.name.hash, hashOf) > 1)
      refuse(program, "is given image " + name + " twice");
  }
}

// The images of all bindings of a program, one after the other.
std::vector<VkDescriptorImageInfo> imagesFor(const Program& program, Bindings bindings) {
  std::vector<VkDescriptorImageInfo> infos;
  for (const ReflectedBinding& wanted : program.reflection().bindings) {
    const auto* given = std::ranges::find(bindings, wanted.hash, hashOf);
    if (given == bindings.end()) refuse(program, "is not given image " + inQuotes(wanted.name));
    if (given->images.size() != wanted.count)
      refuse(program, "takes " + std::to_string(wanted.count) + " images as " + inQuotes(wanted.name) +
                          ", not " + std::to_string(given->images.size()));
    if ((wanted.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER) != (given->sampler != nullptr))
      refuse(program, "given " + inQuotes(wanted.name) + ": a sampler is missing or too many");
    for (const Image* image : given->images) infos.push_back(imageInfo(program, wanted, *given, *image));
  }
  if (bindings.size() != program.reflection().bindings.size()) refuseOthers(program, bindings);
  return infos;
}

}  // namespace

CommandList::CommandList(Device& device, VkCommandBuffer commandBuffer, VkQueryPool timestamps)
    : device_(device), commandBuffer_(commandBuffer), timestamps_(timestamps) {
  if (timestamps_) vkCmdResetQueryPool(commandBuffer_, timestamps_, 0, 2 * kMaxTimedPasses);
}

void CommandList::writeTimestamp(uint32_t query) {
  vkCmdWriteTimestamp2(commandBuffer_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, timestamps_, query);
}

void CommandList::pass(const std::string& name, const std::function<void()>& record) {
  if (device_.hasDebugNames()) {
    auto label = structure<VkDebugUtilsLabelEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT);
    label.pLabelName = name.c_str();
    vkCmdBeginDebugUtilsLabelEXT(commandBuffer_, &label);
  }
  const bool timed = timestamps_ && timedPasses_.size() < kMaxTimedPasses;
  const uint32_t query = 2 * static_cast<uint32_t>(timedPasses_.size());
  if (timed) {
    timedPasses_.push_back(name);
    writeTimestamp(query);
  }
  // After the timestamp: Mesa's software device writes one when it comes to a barrier or to drawing, so that
  // without it a pass that only computes would begin when it ends.
  barrier();
  record();
  if (timed) writeTimestamp(query + 1);
  if (device_.hasDebugNames()) vkCmdEndDebugUtilsLabelEXT(commandBuffer_);
}

void CommandList::barrier() {
  memoryBarrier(commandBuffer_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, kAnyAccess);
}

void CommandList::makeVisibleToHost() {
  memoryBarrier(commandBuffer_, VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
}

void CommandList::bind(const Program& program, std::span<const std::byte> constants, Bindings bindings) {
  const Reflection& reflection = program.reflection();
  // C++ pads a struct to its alignment, GLSL does not.
  const std::size_t padded = (reflection.pushConstantBytes + 7) / 8 * 8;
  if (constants.size() != reflection.pushConstantBytes && constants.size() != padded)
    refuse(program, "takes " + std::to_string(reflection.pushConstantBytes) + " bytes of constants, not " +
                        std::to_string(constants.size()));
  const std::vector<VkDescriptorImageInfo> images = imagesFor(program, bindings);
  vkCmdBindPipeline(commandBuffer_, program.bindPoint(), program.pipeline());
  if (reflection.pushConstantBytes > 0)
    vkCmdPushConstants(commandBuffer_, program.layout(), program.stages(), 0,
                       (reflection.pushConstantBytes + 3) / 4 * 4, constants.data());

  std::vector<VkWriteDescriptorSet> writes;
  const VkDescriptorImageInfo* next = images.data();
  for (const ReflectedBinding& binding : reflection.bindings) {
    auto write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.dstBinding = static_cast<uint32_t>(writes.size());
    write.descriptorCount = binding.count;
    write.descriptorType = binding.type;
    write.pImageInfo = next;
    writes.push_back(write);
    next += binding.count;
  }
  if (!writes.empty())
    vkCmdPushDescriptorSetKHR(commandBuffer_, program.bindPoint(), program.layout(), 0,
                              static_cast<uint32_t>(writes.size()), writes.data());
}

void CommandList::dispatchBytes(const Program& program, uvec3 threads, std::span<const std::byte> constants,
                                Bindings bindings) {
  if (program.bindPoint() != VK_PIPELINE_BIND_POINT_COMPUTE)
    refuse(program, "draws and cannot be dispatched");
  bind(program, constants, bindings);
  uvec3 groups;
  for (int axis = 0; axis < 3; ++axis) {
    const uint32_t size = program.reflection().localSize[static_cast<std::size_t>(axis)];
    groups[axis] = threads[axis] / size + (threads[axis] % size != 0);
    if (groups[axis] > device_.limits().maxComputeWorkGroupCount[axis])
      refuse(program, "is dispatched over too much");
  }
  if (groups.x > 0 && groups.y > 0 && groups.z > 0)
    vkCmdDispatch(commandBuffer_, groups.x, groups.y, groups.z);
}

void CommandList::render(const RenderTargets& targets, const std::function<void()>& draws) {
  std::vector<VkRenderingAttachmentInfo> colors;
  for (const ColorAttachment& color : targets.colors)
    colors.push_back(attachment(*color.image, color.layer,
                                color.clear ? std::optional(clearValue(*color.clear)) : std::nullopt));
  VkRenderingAttachmentInfo depth{};
  if (targets.depth) {
    std::optional<VkClearValue> clear;
    if (targets.depth->clear) clear.emplace().depthStencil = {*targets.depth->clear, 0};
    depth = attachment(*targets.depth->image, targets.depth->layer, clear);
  }
  const Image& any = targets.colors.empty() ? *targets.depth->image : *targets.colors.front().image;
  auto info = structure<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
  const Region region = targets.region.value_or(Region{{0, 0}, {any.width(), any.height()}});
  info.renderArea = {{region.corner.x, region.corner.y}, {region.size.x, region.size.y}};
  info.layerCount = 1;
  info.colorAttachmentCount = static_cast<uint32_t>(colors.size());
  info.pColorAttachments = colors.data();
  info.pDepthAttachment = targets.depth ? &depth : nullptr;
  vkCmdBeginRendering(commandBuffer_, &info);
  const VkViewport viewport{0, 0, static_cast<float>(any.width()), static_cast<float>(any.height()), 0, 1};
  vkCmdSetViewport(commandBuffer_, 0, 1, &viewport);
  vkCmdSetScissor(commandBuffer_, 0, 1, &info.renderArea);
  draws();
  vkCmdEndRendering(commandBuffer_);
}

void CommandList::drawBytes(const Program& program, uint32_t vertexCount, uint32_t instanceCount,
                            std::span<const std::byte> constants, Bindings bindings) {
  bind(program, constants, bindings);
  if (vertexCount > 0 && instanceCount > 0) vkCmdDraw(commandBuffer_, vertexCount, instanceCount, 0, 0);
}

void CommandList::drawIndexedBytes(const Program& program, const Buffer& indices, const IndexRange& range,
                                   uint32_t instanceCount, std::span<const std::byte> constants,
                                   Bindings bindings) {
  bind(program, constants, bindings);
  vkCmdBindIndexBuffer(commandBuffer_, indices.handle(), 0, VK_INDEX_TYPE_UINT32);
  if (range.count > 0 && instanceCount > 0)
    vkCmdDrawIndexed(commandBuffer_, range.count, instanceCount, range.first, range.vertexOffset, 0);
}

void CommandList::drawIndirectBytes(const Program& program, const Buffer& command,
                                    std::span<const std::byte> constants, Bindings bindings) {
  bind(program, constants, bindings);
  vkCmdDrawIndirect(commandBuffer_, command.handle(), 0, 1, sizeof(VkDrawIndirectCommand));
}

void CommandList::clear(const Image& image, vec4 color) {
  const VkImageSubresourceRange all{image.aspect(), 0, image.options().mipLevels, 0, image.layerCount()};
  const VkClearColorValue value = clearValue(color).color;
  vkCmdClearColorImage(commandBuffer_, image.handle(), VK_IMAGE_LAYOUT_GENERAL, &value, 1, &all);
}

void CommandList::fill(const Buffer& buffer, uint32_t word) {
  vkCmdFillBuffer(commandBuffer_, buffer.handle(), 0, VK_WHOLE_SIZE, word);
}

void CommandList::copy(const Buffer& from, const Buffer& to, VkDeviceSize bytes, VkDeviceSize fromOffset,
                       VkDeviceSize toOffset) {
  const VkBufferCopy region{fromOffset, toOffset, bytes};
  if (bytes > 0) vkCmdCopyBuffer(commandBuffer_, from.handle(), to.handle(), 1, &region);
}

void CommandList::copy(const Buffer& from, VkDeviceSize fromOffset, const Image& to, uint32_t layer,
                       uint32_t mipLevel) {
  const VkBufferImageCopy region = regionOf(to, layer, mipLevel, fromOffset);
  vkCmdCopyBufferToImage(commandBuffer_, from.handle(), to.handle(), VK_IMAGE_LAYOUT_GENERAL, 1, &region);
}

void CommandList::copy(const Buffer& from, VkDeviceSize fromOffset, const Image& to, const Region& region) {
  VkBufferImageCopy part = regionOf(to, 0, 0, fromOffset);
  part.imageOffset = {region.corner.x, region.corner.y, 0};
  part.imageExtent = {region.size.x, region.size.y, 1};
  vkCmdCopyBufferToImage(commandBuffer_, from.handle(), to.handle(), VK_IMAGE_LAYOUT_GENERAL, 1, &part);
}

void CommandList::copy(const Image& from, uint32_t layer, const Buffer& to, VkDeviceSize toOffset) {
  const VkBufferImageCopy region = regionOf(from, layer, 0, toOffset);
  vkCmdCopyImageToBuffer(commandBuffer_, from.handle(), VK_IMAGE_LAYOUT_GENERAL, to.handle(), 1, &region);
}

void CommandList::toGeneralLayout(const Image& image) {
  auto barrier = structure<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.dstAccessMask = kAnyAccess;
  barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image.handle();
  barrier.subresourceRange = {image.aspect(), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
  auto dependency = structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  dependency.imageMemoryBarrierCount = 1;
  dependency.pImageMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commandBuffer_, &dependency);
}

}  // namespace nephroid::gpu
