// A Vulkan device that the decoder runs on.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

namespace hmlfc::gpu {

/// What went wrong with the machine, not with the stream.
enum class FailureKind : uint8_t {
  kUnusable,     ///< no driver, no such device, or one that lacks something
  kLimit,        ///< the stream or the call is beyond what the device holds; smaller ones work
  kOutOfMemory,  ///< of the device or the host; smaller streams and calls work
  kLost,         ///< the device was lost, or did not answer in an earlier call
  kTimeout,      ///< the device has not answered in time
  kSource,       ///< the ByteSource of the stream has failed; streams of others work
  kInternal,     ///< a fault of this library or of the driver
};

/// After kLost and kTimeout every further call on the device, also through another decoder or
/// renderer, gives kLost: open it again. Closing the last of them waits for what the device may
/// still be doing. After any other failure the next call begins as if this one had not been, but
/// that a renderer holds no blocks.
struct Failure {
  FailureKind kind = FailureKind::kUnusable;
  std::string message;  ///< one line: what is missing, and what to do
};

template <class T>
using Outcome = tl::expected<T, Failure>;

/// A device of this machine.
struct DeviceInfo {
  std::string name;      ///< as the driver gives it
  std::string kind;      ///< "discrete GPU", "integrated GPU", "virtual GPU", "CPU" or "other"
  std::string missing;   ///< what it lacks for the decoder, or empty
  std::string driver{};  ///< its name and version as the driver gives them
};

/// Kernels as SPIR-V, by the names of their files in shaders/ without .comp.
using KernelCode = std::map<std::string, std::vector<uint32_t>>;

struct DeviceOptions {
  /// The number of a device of list_devices() or a part of its name, in any case. Of several that
  /// fit, the first discrete GPU is taken, else the first of the next kind in the order of
  /// DeviceInfo::kind. Empty: all that can run the decoder.
  std::string device;
  /// Runs under the Khronos validation layer, which must be installed, with its checks of
  /// synchronisation.
  bool validation = false;
  /// Largest buffer in bytes for stream and reference area; 0: the device's own limit. Else a power
  /// of two, at least 64.
  uint64_t chunk_bytes = 0;
  /// Bytes of a stream that wait on the host for their copy to the device, in whole words.
  uint64_t upload_bytes = uint64_t{16} << 20;
  /// Device memory that a submission may take besides the stream, in bytes; larger calls are split.
  uint64_t submission_bytes = uint64_t{512} << 20;
  /// Device memory that the disparity maps of a renderer may take, in bytes: 4 for each block of
  /// plane Y of each view.
  uint64_t disparity_bytes = uint64_t{256} << 20;
  /// The folder where compiled kernels are kept for the next process; empty: none. Not set: hmlfc
  /// in $XDG_CACHE_HOME or in ~/.cache. A file that is not there, damaged or of another driver is
  /// as none, and a folder that cannot be written is no error.
  std::optional<std::string> cache_folder;
  /// For tests: every buffer ends at a page that nobody may touch, so that an access past its end
  /// ends the process. Of devices on the host, with VK_EXT_external_memory_host.
  bool guard_pages = false;
  /// How long a submission may take.
  double timeout_seconds = 600;
  /// For tests: each submission is refused where a barrier is missing or idle (hazards.hpp).
  bool check_barriers = false;
  /// For tests: kernels that run instead of the library's own. Nothing checks the code.
  KernelCode kernels;
};

/// All devices of this machine, in the driver's order. Fails where there is no Vulkan.
Outcome<std::vector<DeviceInfo>> list_devices();

/// What was done since the device was opened.
struct SubmissionCounts {
  uint64_t made = 0;      ///< command buffers with their query pools and fences
  uint64_t recorded = 0;  ///< command buffers, each time anew
  uint64_t barriers = 0;  ///< recorded
  uint64_t submitted = 0;
  uint64_t waits = 0;  ///< for work that the host did not know to be done, however short
};

/// An open device; copies are the same device. Not to be used by two threads at once.
class Device {
 public:
  static Outcome<Device> open(const DeviceOptions& options = {});

  const DeviceInfo& info() const;

  /// What the validation layer has said so far, one message an entry; empty without validation.
  const std::vector<std::string>& validation_messages() const;

  const SubmissionCounts& counts() const;

  /// For this project's own files (device_state.hpp).
  struct State;
  explicit Device(std::shared_ptr<State> state) : state_(std::move(state)) {}
  State& state() { return *state_; }

 private:
  std::shared_ptr<State> state_;  // of all copies
};

}  // namespace hmlfc::gpu
