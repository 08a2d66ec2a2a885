// Words in as many buffers as they need.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "buffer.hpp"

namespace hmlfc::gpu {

/// Device memory of up to 2^32 words in chunks of the device's chunk_bytes, the last one cut.
/// stream_words.glsl and reference_samples.glsl read it.
class ChunkedWords {
 public:
  /// `words` words with undefined content.
  ChunkedWords(Device::State& device, uint64_t words);

  /// log2 of the words of a chunk.
  uint32_t chunk_log2() const { return chunk_log2_; }
  bool chunked() const { return chunks_.size() > 1; }
  uint64_t bytes() const { return bytes_; }

  /// What a kernel takes: the address of the table of chunks, or of the only chunk.
  uint64_t address(bool as_table) const {
    return as_table ? table_->address() : chunks_.front().address();
  }

  /// Writes `bytes` from byte `at` on, which is a multiple of 4; waits until it is done.
  void upload(Device::State& device, uint64_t at, std::span<const uint8_t> bytes);

 private:
  uint64_t bytes_;
  uint32_t chunk_log2_;
  std::vector<Buffer> chunks_;
  std::optional<Buffer> table_;
};

}  // namespace hmlfc::gpu
