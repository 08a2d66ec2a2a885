// The buffers of a submission, kept from one to the next.
#pragma once

#include <optional>

#include "area_batches.hpp"
#include "buffer.hpp"

namespace hmlfc::gpu {

/// A buffer that grows.
class GrowingBuffer {
 public:
  explicit GrowingBuffer(Memory memory) : memory_(memory) {}

  /// At least `bytes` bytes; their content is lost where the buffer grows.
  Buffer& reserve(Device::State& device, uint64_t bytes) {
    if (!buffer_ || buffer_->size() < bytes) {
      buffer_.reset();
      buffer_.emplace(device, bytes, memory_);
    }
    return *buffer_;
  }

  const Buffer& get() const { return *buffer_; }

 private:
  Memory memory_;
  std::optional<Buffer> buffer_;
};

/// Device memory that a submission may take beside the stream.
inline constexpr uint64_t kSubmissionBytes = uint64_t{512} << 20;

/// Sizes that follow from the stream.
struct BlockSizes {
  uint32_t levels = 1;        ///< entries of a request
  uint32_t sample_words = 8;  ///< words of a block's samples

  uint64_t entry_bytes() const { return uint64_t{levels} * kEntryWords * 4; }
  uint64_t sample_bytes() const { return uint64_t{sample_words} * 4; }
  uint64_t stage_bytes() const { return levels * kStageCount * sample_bytes(); }
};

/// The sizes of a stream with this header.
BlockSizes block_sizes(const StreamHeader& header);

/// Most requests of one submission, with stages or not.
uint64_t most_requests(const Device::State& device, const BlockSizes& sizes, bool trace);

/// What one submission reads and writes besides the stream.
struct BatchBuffers {
  GrowingBuffer areas{Memory::kUpload};
  GrowingBuffer colour_areas{Memory::kUpload};
  GrowingBuffer requests{Memory::kDevice};
  GrowingBuffer entries{Memory::kDevice};
  GrowingBuffer statuses{Memory::kDevice};
  GrowingBuffer samples{Memory::kDevice};
  GrowingBuffer stages{Memory::kDevice};
  GrowingBuffer pixels{Memory::kDevice};
  GrowingBuffer pixel_statuses{Memory::kDevice};
  GrowingBuffer readback{Memory::kReadback};

  /// Makes room for `count` requests and what walks leave of them; `arguments` with that.
  Arguments prepare_requests(Device::State& device, uint64_t count, const BlockSizes& sizes,
                             Arguments arguments);

  /// Writes the areas of `batch`, makes room for its results, and returns `arguments` completed.
  Arguments prepare(Device::State& device, const Batch& batch, const BlockSizes& sizes, bool trace,
                    Arguments arguments);
};

}  // namespace hmlfc::gpu
