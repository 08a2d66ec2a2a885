// Kernels that count what each of their invocations executes, on a device whose addresses are those
// of the host, such as lavapipe.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <hmlfc/gpu/device.hpp>

namespace hmlfc::gpu {

/// What invocations execute, in sums over invocations.
struct KernelCounts {
  /// Instructions of a scalar machine of 32 bits. A vector operation is one for each component; a
  /// load or store one for 16 bytes; an index into memory, a condition, a branch, a barrier and an
  /// atomic operation one; an integer division by a number that is no constant 20; products of 64
  /// bits and sums with a carry 2. Free: moves, constants, unconditional branches, push constants.
  uint64_t instructions = 0;
  uint64_t uniform = 0;  ///< of them, where all invocations of a workgroup have the same operands
  uint64_t loads = 0;    ///< of buffers, where invocations of a workgroup may differ in address
  uint64_t uniform_loads = 0;  ///< of buffers, where all have the same address
  uint64_t stores = 0;         ///< to buffers
  uint64_t shared = 0;         ///< loads and stores of shared memory
  uint64_t atomics = 0;        ///< of buffers: the tests and changes of bits and counters
};

/// The members of KernelCounts.
inline constexpr size_t kCountKinds = 7;

/// The counters behind counting kernels. They are written by any device that runs those.
class KernelCounter {
 public:
  KernelCounter();
  ~KernelCounter();
  KernelCounter(KernelCounter&&) noexcept;
  KernelCounter& operator=(KernelCounter&&) noexcept;

  /// All kernels of the library, counting, for DeviceOptions::kernels. They outlive no counter.
  KernelCode kernels();

  /// `code`, a kernel in one function, counting as kernel `name`.
  std::vector<uint32_t> counting(const std::string& name, std::span<const uint32_t> code);

  /// What ran since the last call, by kernel; kernels that did not run are left out.
  std::map<std::string, KernelCounts> take();

 private:
  struct Counters;
  std::unique_ptr<Counters> counters_;
};

}  // namespace hmlfc::gpu
