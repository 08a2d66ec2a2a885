#include <hmlfc/gpu/vulkan_device.hpp>

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "device_state.hpp"

namespace hmlfc::gpu {
namespace {

MachineError unusable(const std::string& message) {
  return {FailureKind::kUnusable, "VulkanDevice: " + message};
}

// The caller destroys them: here nothing is to be done.
VKAPI_ATTR void VKAPI_CALL keep_instance(VkInstance, const VkAllocationCallbacks*) {}
VKAPI_ATTR void VKAPI_CALL keep_device(VkDevice, const VkAllocationCallbacks*) {}

// The calls of one object, which vk::raii made for it alone.
template <class Dispatcher>
Dispatcher& own_calls(const Dispatcher* calls) {
  return const_cast<Dispatcher&>(*calls);
}

void check_handles(const VulkanDevice& handles) {
  const std::pair<const char*, bool> missing[] = {{"instance", handles.instance == nullptr},
                                                  {"physical", handles.physical == nullptr},
                                                  {"device", handles.device == nullptr},
                                                  {"created", handles.created == nullptr},
                                                  {"queue", handles.queue == nullptr}};
  for (const auto& [name, is_missing] : missing) {
    if (is_missing) throw unusable(std::string(name) + " is null");
  }
  if ((handles.memory.allocate == nullptr) != (handles.memory.free == nullptr)) {
    throw unusable("memory has one of allocate and free without the other");
  }
}

void check_options(const DeviceOptions& options) {
  const std::pair<const char*, bool> set[] = {{"device", !options.device.empty()},
                                              {"validation", options.validation},
                                              {"guard_pages", options.guard_pages}};
  for (const auto& [name, is_set] : set) {
    if (is_set)
      throw unusable(std::string("DeviceOptions::") + name + " is for Device::open alone");
  }
}

// Whether the feature is on, by either of the records that can say so.
bool has_addresses(const VkDeviceCreateInfo& created) {
  for (auto* next = static_cast<const VkBaseInStructure*>(created.pNext); next != nullptr;
       next = next->pNext) {
    const void* record = next;
    if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES &&
        static_cast<const VkPhysicalDeviceBufferDeviceAddressFeatures*>(record)
                ->bufferDeviceAddress == VK_TRUE) {
      return true;
    }
    if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES &&
        static_cast<const VkPhysicalDeviceVulkan12Features*>(record)->bufferDeviceAddress ==
            VK_TRUE) {
      return true;
    }
  }
  return false;
}

void check_queue(const Device::State& state, const VulkanDevice& handles) {
  const std::string family = "queue_family " + std::to_string(handles.queue_family);
  const std::span<const VkDeviceQueueCreateInfo> queues(handles.created->pQueueCreateInfos,
                                                        handles.created->queueCreateInfoCount);
  const auto made =
      std::ranges::find(queues, handles.queue_family, &VkDeviceQueueCreateInfo::queueFamilyIndex);
  if (made == queues.end()) throw unusable("the device was made without queues of " + family);
  const auto families = state.physical->getQueueFamilyProperties();
  if (handles.queue_family >= families.size() ||
      !(families[handles.queue_family].queueFlags & vk::QueueFlagBits::eCompute)) {
    throw unusable(family + " has no compute (VK_QUEUE_COMPUTE_BIT)");
  }
  if (made->flags != 0) return;  // its queues are asked for in another way
  for (uint32_t i = 0; i < made->queueCount; ++i) {
    const vk::raii::Queue queue(*state.device, handles.queue_family, i);
    if (static_cast<VkQueue>(*queue) == handles.queue) return;
  }
  throw unusable("queue is none of " + family);
}

std::shared_ptr<Device::State> open_state(const VulkanDevice& handles,
                                          const DeviceOptions& options) {
  check_handles(handles);
  check_options(options);
  auto state = make_state();
  state->instance.emplace(state->context, handles.instance);
  own_calls(state->instance->getDispatcher()).vkDestroyInstance = &keep_instance;
  state->physical.emplace(*state->instance, handles.physical);
  state->device.emplace(*state->physical, handles.device);
  own_calls(state->device->getDispatcher()).vkDestroyDevice = &keep_device;
  if (state->device->getDispatcher()->vkGetBufferDeviceAddress == nullptr) {
    throw unusable("instance or device were made for a Vulkan below 1.2");
  }
  state->info = info_of(*state->physical);
  if (!state->info.missing.empty()) {
    throw unusable(state->info.name + " has no " + state->info.missing +
                   ", or the instance was made for a Vulkan below 1.2");
  }
  if (!has_addresses(*handles.created)) {
    throw unusable(
        "the device was made without bufferDeviceAddress: turn it on in "
        "VkPhysicalDeviceVulkan12Features");
  }
  check_queue(*state, handles);
  state->queue.emplace(*state->device, handles.queue);
  state->memory = handles.memory;
  complete(*state, handles.queue_family, options);
  return state;
}

}  // namespace

Outcome<Device> open_device(const VulkanDevice& handles, const DeviceOptions& options) {
  return guard_device([&] { return Device(open_state(handles, options)); });
}

VulkanDevice vulkan_device(Device& device) {
  const Device::State& state = device.state();
  return {**state.instance, **state.physical, **state.device, nullptr,
          state.family,     **state.queue,    state.memory};
}

}  // namespace hmlfc::gpu
