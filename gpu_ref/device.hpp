// A Vulkan device that the decoder runs on.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

namespace hmlfc::gpu {

/// What went wrong with the machine, not with the stream: a missing driver or device, no memory, a
/// lost device, or a stream beyond what the device holds.
struct Failure {
  std::string message;  ///< one line: what is missing, and what to do
};

template <class T>
using Outcome = tl::expected<T, Failure>;

/// A device of this machine.
struct DeviceInfo {
  std::string name;          ///< as the driver gives it
  std::string kind;          ///< "GPU", "CPU" or "other"
  std::string missing;       ///< what it lacks for the decoder, or empty
  uint64_t max_binding = 0;  ///< bytes of its largest storage buffer binding
};

/// Kernels as SPIR-V, by the names of their files in shaders/ without .comp.
using KernelCode = std::map<std::string, std::vector<uint32_t>>;

struct DeviceOptions {
  /// The number of a device of list_devices() or a part of its name, in any case. Empty: the first
  /// GPU that can run the decoder, else the first other device that can.
  std::string device;
  /// Runs under the Khronos validation layer, which must be installed, with its checks of
  /// synchronisation.
  bool validation = false;
  /// Largest buffer in bytes for stream and reference area; 0: the device's own limit. Else a power
  /// of two, at least 64.
  uint64_t chunk_bytes = 0;
  /// For tests: every buffer ends at a page that nobody may touch, so that an access past its end
  /// ends the process. Of devices on the host, with VK_EXT_external_memory_host.
  bool guard_pages = false;
  /// For tests: each submission is refused where a barrier is missing or idle (hazards.hpp).
  bool check_barriers = false;
  /// For tests: kernels that run in place of the library's own. Nothing checks the code.
  KernelCode kernels;
};

/// All devices of this machine, in the driver's order. Fails where there is no Vulkan.
Outcome<std::vector<DeviceInfo>> list_devices();

/// An open device; copies are the same device. Not to be used by two threads at once.
class Device {
 public:
  static Outcome<Device> open(const DeviceOptions& options = {});

  const DeviceInfo& info() const;

  /// What the validation layer has said so far, one message an entry; empty without validation.
  const std::vector<std::string>& validation_messages() const;

  struct State;
  State& state() { return *state_; }

 private:
  explicit Device(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;  // of all copies
};

}  // namespace hmlfc::gpu
