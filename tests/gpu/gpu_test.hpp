// Fixtures of the GPU decoder's tests.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include <hmlfc/gpu/decoder.hpp>

#include "gpu/stream_check.hpp"
#include "stimulus/sequences.hpp"

namespace hmlfc::gpu {

/// A test that needs a device; skipped with the reason where there is none. HMLFC_GPU_DEVICE names
/// one, as --device does; HMLFC_GPU_KERNELS is a folder of kernels to use instead of the library's
/// own (tests/faults/shaders.toml).
class GpuTest : public testing::Test {
 protected:
  void SetUp() override;

  /// Opens a device that checks barriers and, where it can, has guarded pages. A failure of the
  /// test where there is none with these options.
  static std::optional<Device> open(const DeviceOptions& options);

  /// Opens it under the validation layer, where that is installed.
  static std::optional<Device> open_validated();

  /// Opens one without these checks: the check of barriers records each frame again.
  static std::optional<Device> open_unchecked(DeviceOptions options);

  /// The device that most tests share, as open({}) gives it.
  static Device& device();
};

/// Which requests of a stream to compare.
struct CheckPlan {
  uint64_t requests = 400;  ///< of all kinds, besides those at the borders
  uint64_t seed = 0;
  bool borders = true;
  uint64_t blocks_at_once = uint64_t{1} << 24;  ///< maximum of blocks in a submission
};

/// Compares the stream `bytes` on `device` with the model, at all stages; fails the test at a
/// difference. Returns the counts of what was compared: nothing of a stream that does not open.
CheckCounts expect_equal(Device& device, std::span<const uint8_t> bytes, const CheckPlan& plan);

/// Compares all blocks of the views that `plan` says, in RGB, at all stages; fails the test at a
/// difference or an error. The counts of what was compared.
CheckCounts expect_scan_equal(GpuDecoder& decoder, std::span<const uint8_t> bytes,
                              const tb::ScanPlan& plan);

}  // namespace hmlfc::gpu
