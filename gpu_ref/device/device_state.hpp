// What an open device holds.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <hmlfc/gpu/device.hpp>
#include <hmlfc/gpu/vulkan_device.hpp>

#include "hazards.hpp"
#include "kernels.hpp"
#include "machine_error.hpp"
#include "vulkan_hpp.hpp"

namespace hmlfc::gpu {

/// Returns the number of the device that DeviceOptions::device = `wanted` means; devices.size() for
/// none.
size_t choose_device(const std::vector<DeviceInfo>& devices, const std::string& wanted);

struct Device::State {
  ~State();

  vk::raii::Context context;
  std::vector<std::string> messages;
  std::optional<vk::raii::Instance> instance;
  std::optional<vk::raii::DebugUtilsMessengerEXT> messenger;
  std::optional<vk::raii::PhysicalDevice> physical;
  std::optional<vk::raii::Device> device;
  std::optional<vk::raii::Queue> queue;
  std::optional<vk::raii::CommandPool> pool;
  std::optional<Kernels> kernels;
  DeviceInfo info;
  uint32_t family = 0;              ///< of the queue
  uint64_t chunk_bytes = 0;         ///< largest buffer of stream and reference area
  uint64_t upload_bytes = 0;        ///< a multiple of 4
  uint64_t max_buffer_bytes = 0;    ///< largest buffer of anything else
  uint64_t submission_bytes = 0;    ///< DeviceOptions::submission_bytes
  uint64_t disparity_bytes = 0;     ///< DeviceOptions::disparity_bytes
  uint32_t max_workgroups = 65535;  ///< in one dimension
  double timestamp_seconds = 0;     ///< of one tick; 0: no timestamps
  uint64_t timestamp_mask = 0;      ///< the bits of a tick that are valid
  uint64_t timeout_nanoseconds = 0;
  MemoryCallbacks memory;          ///< VulkanDevice::memory
  bool lost = false;               ///< FailureKind::kLost or kTimeout has been given
  bool guard_pages = false;        ///< DeviceOptions::guard_pages
  std::optional<Hazards> hazards;  ///< with DeviceOptions::check_barriers

  /// What a submission needs on the device. Later submissions use it again.
  struct SubmissionHandles {
    vk::raii::CommandBuffer commands;
    vk::raii::QueryPool queries;
    vk::raii::Fence fence;
  };
  std::vector<SubmissionHandles> idle;
  std::vector<SubmissionHandles> abandoned;  ///< without an answer: the device may still use them
  SubmissionCounts counts;

  /// Waits for what a lost device may still be doing. Called before its memory is freed.
  void settle() noexcept;
};

/// Returns a state in which nothing is open yet.
std::shared_ptr<Device::State> make_state();

DeviceInfo info_of(const vk::raii::PhysicalDevice& physical);

/// Completes `state`, which has instance, physical device, device and queue: makes the pool of
/// commands for the queue's `family` and the kernels, and sets the limits that `options` ask for.
void complete(Device::State& state, uint32_t family, const DeviceOptions& options);

/// Runs `body() -> T` and turns what it throws into a Failure.
template <class Body>
auto guard_device(const Body& body) -> Outcome<decltype(body())> {
  try {
    if constexpr (std::is_void_v<decltype(body())>) {
      body();
      return {};
    } else {
      return body();
    }
  } catch (const MachineError& error) {
    return tl::unexpected(Failure{error.kind(), error.what()});
  } catch (const vk::OutOfDeviceMemoryError&) {
    return tl::unexpected(
        Failure{FailureKind::kOutOfMemory, "the device has too little memory for this stream"});
  } catch (const vk::OutOfHostMemoryError&) {
    return tl::unexpected(Failure{FailureKind::kOutOfMemory, "out of memory"});
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Failure{FailureKind::kOutOfMemory, "out of memory"});
  } catch (const vk::DeviceLostError&) {
    return tl::unexpected(Failure{FailureKind::kLost, "the device was lost: open it again"});
  } catch (const std::exception& error) {
    return tl::unexpected(Failure{FailureKind::kInternal, std::string("Vulkan: ") + error.what()});
  }
}

}  // namespace hmlfc::gpu
