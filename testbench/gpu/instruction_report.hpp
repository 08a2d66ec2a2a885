// What the kernels execute a pixel: of whole views decoded and of frames drawn.
#pragma once

#include <map>
#include <string>
#include <utility>

#include <hmlfc/camera.hpp>
#include <hmlfc/gpu/decoder.hpp>

#include "gpu/kernel_counter.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc::gpu {

/// Counts of some work by kernel, and the pixels that it made.
struct InstructionTable {
  std::string work;
  uint64_t pixels = 0;
  std::map<std::string, KernelCounts> kernels{};

  KernelCounts total() const;
};

/// Counts on a device whose addresses are those of the host.
class InstructionReport {
 public:
  /// Of kind CPU, such as lavapipe; fails on others.
  static Outcome<InstructionReport> open(DeviceOptions options);

  /// Of the first view and `views` more, whole and in RGB, spread over the grid of `stream`.
  Outcome<InstructionTable> decode(const StreamView& stream, uint64_t views);

  /// Of three frames of records_of_path(), each with nothing held before it (`cold`), or
  /// with all that it needs held.
  Outcome<InstructionTable> frames(const StreamView& stream, const Camera& camera, bool cold);

 private:
  InstructionReport(KernelCounter counter, Device device)
      : counter_(std::move(counter)), device_(std::move(device)) {}

  KernelCounter counter_;
  Device device_;
};

/// A row for each kernel and one for all: counts a pixel.
std::string to_text(const InstructionTable& table);

}  // namespace hmlfc::gpu
