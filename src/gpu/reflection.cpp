#include "gpu/reflection.h"

#include <spirv_cross_c.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace nephroid::gpu {
namespace {

struct Kind {
  spvc_resource_type resource;
  VkDescriptorType descriptor;
};

constexpr Kind kImageKinds[] = {
    {SPVC_RESOURCE_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE},
    {SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
    {SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
};

constexpr spvc_resource_type kUnsupported[] = {
    SPVC_RESOURCE_TYPE_UNIFORM_BUFFER,
    SPVC_RESOURCE_TYPE_STORAGE_BUFFER,
    SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS,
};

std::span<const spvc_reflected_resource> listOf(spvc_resources resources, spvc_resource_type type) {
  const spvc_reflected_resource* list = nullptr;
  size_t count = 0;
  spvc_resources_get_resource_list_for_type(resources, type, &list, &count);
  return {list, count};
}

uint32_t pushConstantBytes(spvc_compiler compiler, spvc_resources resources) {
  size_t bytes = 0;
  for (const auto& block : listOf(resources, SPVC_RESOURCE_TYPE_PUSH_CONSTANT))
    spvc_compiler_get_declared_struct_size(
        compiler, spvc_compiler_get_type_handle(compiler, block.base_type_id), &bytes);
  return static_cast<uint32_t>(bytes);
}

// The images of an array; 1 where it is none.
uint32_t arraySize(spvc_type type) {
  uint32_t count = 1;
  for (unsigned dimension = 0; dimension < spvc_type_get_num_array_dimensions(type); ++dimension)
    count *= spvc_type_get_array_dimension(type, dimension);
  return count;
}

std::vector<ReflectedConstant> constantsOf(spvc_compiler compiler) {
  const spvc_specialization_constant* list = nullptr;
  size_t count = 0;
  spvc_compiler_get_specialization_constants(compiler, &list, &count);
  std::vector<ReflectedConstant> constants;
  for (const spvc_specialization_constant& constant : std::span(list, count))
    constants.push_back({spvc_compiler_get_name(compiler, constant.id), constant.constant_id});
  return constants;
}

}  // namespace

Reflection reflect(const std::string& name, std::span<const uint32_t> spirv) {
  const auto fail = [&](const std::string& why) -> std::logic_error {
    return std::logic_error("shader " + name + ": " + why);
  };
  spvc_context context = nullptr;
  if (spvc_context_create(&context) != SPVC_SUCCESS) throw fail("no memory to reflect it");
  const std::unique_ptr<spvc_context_s, decltype(&spvc_context_destroy)> owner(context, spvc_context_destroy);
  spvc_parsed_ir parsed = nullptr;
  spvc_compiler compiler = nullptr;
  spvc_resources resources = nullptr;
  if (spvc_context_parse_spirv(context, spirv.data(), spirv.size(), &parsed) != SPVC_SUCCESS ||
      spvc_context_create_compiler(context, SPVC_BACKEND_NONE, parsed, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP,
                                   &compiler) != SPVC_SUCCESS ||
      spvc_compiler_create_shader_resources(compiler, &resources) != SPVC_SUCCESS)
    throw fail(spvc_context_get_last_error_string(context));

  Reflection reflection;
  reflection.pushConstantBytes = pushConstantBytes(compiler, resources);
  for (unsigned axis = 0; axis < 3; ++axis)
    reflection.localSize[axis] = std::max(
        1u, spvc_compiler_get_execution_mode_argument_by_index(compiler, SpvExecutionModeLocalSize, axis));
  spvc_specialization_constant x{}, y{}, z{};
  spvc_compiler_get_work_group_size_specialization_constants(compiler, &x, &y, &z);
  if (x.id != 0) reflection.subgroupSizeId = x.constant_id;
  for (const spvc_resource_type type : kUnsupported)
    if (!listOf(resources, type).empty()) throw fail("only images are bound; buffers are passed by address");
  for (const Kind& kind : kImageKinds)
    for (const auto& resource : listOf(resources, kind.resource)) {
      if (spvc_compiler_get_decoration(compiler, resource.id, SpvDecorationDescriptorSet) != 0)
        throw fail("descriptor sets other than 0 are not fed");
      // The compiler numbers what the shader uses, and nothing else.
      unsigned numberAt = 0;
      if (!spvc_compiler_get_binary_offset_for_decoration(compiler, resource.id, SpvDecorationBinding,
                                                          &numberAt))
        continue;
      const spvc_type type = spvc_compiler_get_type_handle(compiler, resource.type_id);
      reflection.bindings.push_back({resource.name, hashOfName(resource.name), kind.descriptor,
                                     spvc_type_get_image_arrayed(type) != 0, arraySize(type), numberAt});
    }
  reflection.constants = constantsOf(compiler);
  return reflection;
}

}  // namespace nephroid::gpu
