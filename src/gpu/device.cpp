#include "gpu/device.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "core/error.h"
#include "gpu/command_list.h"

namespace nephroid::gpu {
namespace {

// The features the programs are written against, chained for vkGetPhysicalDeviceFeatures2 and vkCreateDevice.
struct Features {
  VkPhysicalDeviceVulkan13Features v13 =
      structure<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
  VkPhysicalDeviceVulkan12Features v12 =
      structure<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
  VkPhysicalDeviceVulkan11Features v11 =
      structure<VkPhysicalDeviceVulkan11Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES);
  VkPhysicalDeviceFeatures2 all =
      structure<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);

  Features() {
    all.pNext = &v11;
    v11.pNext = &v12;
    v12.pNext = &v13;
  }
  Features(const Features&) = delete;
  Features& operator=(const Features&) = delete;

  auto required() {
    return std::to_array<std::pair<const char*, VkBool32*>>({
        {"dynamicRendering", &v13.dynamicRendering},
        {"synchronization2", &v13.synchronization2},
        {"maintenance4", &v13.maintenance4},
        {"subgroupSizeControl", &v13.subgroupSizeControl},
        {"computeFullSubgroups", &v13.computeFullSubgroups},
        {"scalarBlockLayout", &v12.scalarBlockLayout},
        {"bufferDeviceAddress", &v12.bufferDeviceAddress},
        {"independentBlend", &all.features.independentBlend},
        {"largePoints", &all.features.largePoints},
        {"fragmentStoresAndAtomics", &all.features.fragmentStoresAndAtomics},
        {"vertexPipelineStoresAndAtomics", &all.features.vertexPipelineStoresAndAtomics},
    });
  }
};

constexpr uint32_t kLeastSubgroup = 4, kMostSubgroup = 64;  // threads, that the programs are written for

std::string versionText(uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) +
         "." + std::to_string(VK_API_VERSION_PATCH(version));
}

std::string typeText(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "software";
    default:
      return "other";
  }
}

bool hasDeviceExtension(VkPhysicalDevice device, const char* name) {
  uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
  return std::ranges::any_of(extensions,
                             [&](const auto& e) { return std::strcmp(e.extensionName, name) == 0; });
}

std::optional<uint32_t> findQueueFamily(VkPhysicalDevice device, uint32_t* timestampBits) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  constexpr VkQueueFlags kWanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  for (uint32_t i = 0; i < count; ++i) {
    if ((families[i].queueFlags & kWanted) != kWanted) continue;
    *timestampBits = families[i].timestampValidBits;
    return i;
  }
  return std::nullopt;
}

// What compute shaders can do with subgroups.
struct Subgroups {
  bool canShuffle = false;      // and ballot
  uint32_t usual = 0;           // threads, where the driver chooses
  std::vector<uint32_t> sizes;  // threads that can be asked for, of those the programs are written for
};

Subgroups subgroupsOf(VkPhysicalDevice device) {
  auto sizes = structure<VkPhysicalDeviceSubgroupSizeControlProperties>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES);
  auto subgroups =
      structure<VkPhysicalDeviceSubgroupProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES);
  subgroups.pNext = &sizes;
  auto properties = structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
  properties.pNext = &subgroups;
  vkGetPhysicalDeviceProperties2(device, &properties);
  constexpr VkSubgroupFeatureFlags kWanted = VK_SUBGROUP_FEATURE_BALLOT_BIT | VK_SUBGROUP_FEATURE_SHUFFLE_BIT;
  Subgroups found;
  found.canShuffle = (subgroups.supportedOperations & kWanted) == kWanted &&
                     (subgroups.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
  found.usual = subgroups.subgroupSize;
  if ((sizes.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0)
    for (uint32_t size = kLeastSubgroup; size <= kMostSubgroup; size *= 2)
      if (size >= sizes.minSubgroupSize && size <= sizes.maxSubgroupSize) found.sizes.push_back(size);
  return found;
}

std::vector<std::string> missingFrom(VkPhysicalDevice device, uint32_t apiVersion) {
  if (apiVersion < VK_API_VERSION_1_3) return {"Vulkan 1.3"};
  std::vector<std::string> missing;
  Features supported;
  vkGetPhysicalDeviceFeatures2(device, &supported.all);
  for (const auto& [name, value] : supported.required())
    if (!*value) missing.emplace_back(name);
  if (!hasDeviceExtension(device, VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME))
    missing.emplace_back(VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
  const Subgroups subgroups = subgroupsOf(device);
  if (!subgroups.canShuffle) missing.emplace_back("ballots and shuffles in subgroups of compute shaders");
  if (subgroups.sizes.empty())
    missing.emplace_back("compute shaders with subgroups of 4 to 64 threads, as asked for");
  uint32_t timestampBits = 0;
  if (!findQueueFamily(device, &timestampBits)) missing.emplace_back("a queue for graphics and compute");
  return missing;
}

DeviceInfo describe(VkPhysicalDevice device, uint32_t index) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(device, &properties);
  DeviceInfo info;
  info.index = index;
  info.name = properties.deviceName;
  info.type = typeText(properties.deviceType);
  info.apiVersion = versionText(properties.apiVersion);
  if (properties.apiVersion >= VK_API_VERSION_1_2) {
    auto driver =
        structure<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
    auto more = structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    more.pNext = &driver;
    vkGetPhysicalDeviceProperties2(device, &more);
    info.driver = std::string(driver.driverName) + " " + driver.driverInfo;
  }
  if (properties.apiVersion >= VK_API_VERSION_1_3) info.subgroupSizes = subgroupsOf(device).sizes;
  info.missing = missingFrom(device, properties.apiVersion);
  return info;
}

std::vector<DeviceInfo> describeAll(const std::vector<VkPhysicalDevice>& devices) {
  std::vector<DeviceInfo> infos;
  for (const VkPhysicalDevice device : devices)
    infos.push_back(describe(device, static_cast<uint32_t>(infos.size())));
  return infos;
}

std::string lowerCase(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

const DeviceInfo& chosenByName(const std::vector<DeviceInfo>& infos, const std::string& wanted) {
  std::vector<std::string> known;
  for (const DeviceInfo& info : infos) {
    if (wanted == std::to_string(info.index)) return info;
    known.push_back(std::to_string(info.index) + " \"" + info.name + "\"");
  }
  for (const DeviceInfo& info : infos)
    if (lowerCase(info.name).find(lowerCase(wanted)) != std::string::npos) return info;
  throw InputError("no Vulkan device is called \"" + wanted + "\"; there are: " + joined(known));
}

const DeviceInfo& chosenByItself(const std::vector<DeviceInfo>& infos) {
  for (const char* type : {"discrete", "integrated", "virtual", "software", "other"})
    for (const DeviceInfo& info : infos)
      if (info.type == type && info.missing.empty()) return info;
  return infos.front();
}

// The size (threads) that is wanted, or of those offered the one that is nearest to what the driver itself
// would choose.
uint32_t chosenSubgroupSize(VkPhysicalDevice device, const DeviceInfo& info, uint32_t wanted) {
  const std::vector<uint32_t>& offered = info.subgroupSizes;
  if (wanted == 0) return std::clamp(subgroupsOf(device).usual, offered.front(), offered.back());
  if (std::ranges::find(offered, wanted) == offered.end())
    throw InputError("the Vulkan device \"" + info.name + "\" offers no subgroups of " +
                     std::to_string(wanted) + " threads");
  return wanted;
}

bool validationWanted(const DeviceOptions& options) {
  const char* environment = std::getenv("NEPHROID_VALIDATION");
  return options.validation || (environment && std::strcmp(environment, "1") == 0);
}

}  // namespace

std::vector<DeviceInfo> listDevices() {
  const Instance instance(false);
  return describeAll(instance.physicalDevices());
}

Device::Device(const DeviceOptions& options)
    : instance_(validationWanted(options), options.surfaceExtensions) {
  const std::vector<VkPhysicalDevice> devices = instance_.physicalDevices();
  const std::vector<DeviceInfo> infos = describeAll(devices);
  info_ = options.device.empty() ? chosenByItself(infos) : chosenByName(infos, options.device);
  if (!info_.missing.empty())
    throw RuntimeFailure(
        "the Vulkan device \"" + info_.name + "\" lacks " + joined(info_.missing) +
        ": update its driver, or install Mesa's software Vulkan (package mesa-vulkan-drivers)");
  physicalDevice_ = devices[info_.index];
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physicalDevice_, &properties);
  limits_ = properties.limits;
  subgroupSize_ = chosenSubgroupSize(physicalDevice_, info_, options.subgroupSize);
  const bool showsPictures = !options.surfaceExtensions.empty();
  if (showsPictures && !hasDeviceExtension(physicalDevice_, VK_KHR_SWAPCHAIN_EXTENSION_NAME))
    throw RuntimeFailure("the Vulkan device \"" + info_.name + "\" cannot show pictures in a window");
  createDevice(showsPictures);
}

void Device::createDevice(bool showsPictures) {
  queueFamily_ = *findQueueFamily(physicalDevice_, &timestampBits_);
  const float priority = 1;
  auto queue = structure<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue.queueFamilyIndex = queueFamily_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;

  Features features;
  for (const auto& [name, value] : features.required()) *value = VK_TRUE;
  std::vector<const char*> extensions{VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};
  if (showsPictures) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  auto info = structure<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  info.pNext = &features.all;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  check(vkCreateDevice(physicalDevice_, &info, nullptr, &handle_),
        "creating the device \"" + info_.name + "\"");
  vkGetDeviceQueue(handle_, queueFamily_, 0, &queue_);

  auto pool = structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool.queueFamilyIndex = queueFamily_;
  check(vkCreateCommandPool(handle_, &pool, nullptr, &commandPool_), "creating the command pool");
  auto buffer = structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  buffer.commandPool = commandPool_;
  buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  buffer.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(handle_, &buffer, &commandBuffer_), "allocating the command buffer");
  const auto fence = structure<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  check(vkCreateFence(handle_, &fence, nullptr, &fence_), "creating the fence");
  if (timestampBits_ > 0) {
    auto queries = structure<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
    queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
    queries.queryCount = 2 * CommandList::kMaxTimedPasses;
    check(vkCreateQueryPool(handle_, &queries, nullptr, &queryPool_), "creating the timestamp queries");
  }
  memory_ = std::make_unique<MemoryPool>(physicalDevice_, handle_, info_.name);
}

Device::~Device() {
  memory_.reset();
  if (queryPool_) vkDestroyQueryPool(handle_, queryPool_, nullptr);
  vkDestroyFence(handle_, fence_, nullptr);
  vkDestroyCommandPool(handle_, commandPool_, nullptr);
  vkDestroyDevice(handle_, nullptr);
}

VkResult Device::present(const VkPresentInfoKHR& what) {
  const std::lock_guard lock(queueUse_);
  return vkQueuePresentKHR(queue_, &what);
}

void Device::waitForQueue() {
  const std::lock_guard lock(queueUse_);
  vkQueueWaitIdle(queue_);
}

std::vector<PassTime> Device::submitAndWait(const std::function<void(CommandList&)>& record) {
  const std::lock_guard lock(queueUse_);
  check(vkResetCommandPool(handle_, commandPool_, 0), "resetting the command pool");
  auto begin = structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commandBuffer_, &begin), "beginning a command buffer");
  CommandList commands(*this, commandBuffer_, queryPool_);
  record(commands);
  commands.makeVisibleToHost();
  check(vkEndCommandBuffer(commandBuffer_), "ending a command buffer");

  auto buffer = structure<VkCommandBufferSubmitInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO);
  buffer.commandBuffer = commandBuffer_;
  auto submit = structure<VkSubmitInfo2>(VK_STRUCTURE_TYPE_SUBMIT_INFO_2);
  submit.commandBufferInfoCount = 1;
  submit.pCommandBufferInfos = &buffer;
  check(vkQueueSubmit2(queue_, 1, &submit, fence_), "submitting commands");
  check(vkWaitForFences(handle_, 1, &fence_, VK_TRUE, UINT64_MAX), "waiting for the device");
  check(vkResetFences(handle_, 1, &fence_), "resetting the fence");
  return readPassTimes(commands);
}

std::vector<PassTime> Device::readPassTimes(const CommandList& commands) const {
  const std::vector<std::string>& names = commands.timedPasses();
  std::vector<uint64_t> ticks(2 * names.size());
  if (names.empty()) return {};
  check(vkGetQueryPoolResults(handle_, queryPool_, 0, static_cast<uint32_t>(ticks.size()),
                              ticks.size() * sizeof(uint64_t), ticks.data(), sizeof(uint64_t),
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "reading timestamps");
  const uint64_t mask = timestampBits_ >= 64 ? ~uint64_t{0} : (uint64_t{1} << timestampBits_) - 1;
  std::vector<PassTime> times;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const uint64_t elapsed = (ticks[2 * i + 1] - ticks[2 * i]) & mask;
    times.push_back({names[i], static_cast<double>(elapsed) * limits_.timestampPeriod * 1e-6});
  }
  return times;
}

void Device::setName(VkObjectType type, uint64_t object, const std::string& name) const {
  if (!hasDebugNames()) return;
  auto info = structure<VkDebugUtilsObjectNameInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT);
  info.objectType = type;
  info.objectHandle = object;
  info.pObjectName = name.c_str();
  vkSetDebugUtilsObjectNameEXT(handle_, &info);
}

}  // namespace nephroid::gpu
