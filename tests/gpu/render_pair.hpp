// One stream in the GPU renderer and in the golden one.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <hmlfc/gpu/renderer.hpp>
#include <hmlfc/renderer.hpp>

#include "gpu/cache_model.hpp"
#include "render/render_cases.hpp"

namespace hmlfc::gpu {

/// Counts of what was compared.
struct FrameTally {
  uint64_t frames = 0;
  uint64_t failed = 0;     ///< with an error, equal in both
  uint64_t lit = 0;        ///< with a sample above 0
  uint64_t coarse = 0;     ///< of a stop level above 0
  uint64_t displaced = 0;  ///< with a displacement that is not 0
  uint64_t repeated = 0;   ///< that took two submissions
  uint64_t needed = 0;     ///< blocks
  uint64_t decoded = 0;    ///< of them
};

/// Frames of both renderers, one after the other, and what a cache of `cache_bytes` holds of them.
class RenderPair {
 public:
  RenderPair(Device& device, std::vector<uint8_t> bytes, uint64_t cache_bytes);

  /// Returns whether there is nothing to compare, because the stream does not open.
  bool closed() const { return !gpu_; }

  const StreamHeader& header() const { return view_->header; }

  /// Returns the first difference of a frame: status, size, samples, blocks needed and decoded.
  /// Empty where there is none.
  std::string difference(const FrameRecord& record, int stop_level, FrameTally& tally);

  /// Fails the test where there is one.
  void compare(const FrameRecord& record, int stop_level, FrameTally& tally);

  /// What the device said of the last frame.
  const GpuFrame& last() const { return last_; }

  void forget() {
    gpu_->forget();
    model_->forget();
  }

 private:
  test::OpenedStream stream_;
  Result<StreamView> view_;
  std::unique_ptr<FrameRenderer> golden_;
  std::optional<GpuRenderer> gpu_;
  std::optional<CacheModel> model_;
  GpuFrame last_;
};

}  // namespace hmlfc::gpu
