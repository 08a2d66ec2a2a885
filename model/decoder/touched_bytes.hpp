// How much of a stream is read.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include <hmlfc/decoder.hpp>

namespace hmlfc {

/// The bytes that were read since the last call of reset(), each counted once, in whole lines of
/// kLineBytes as memory fetches them, and the samples of key images that were decoded.
class TouchedBytes final : public ReadSink {
 public:
  static constexpr uint64_t kLineBytes = 64;

  /// For a file of at most `file_bytes` bytes.
  explicit TouchedBytes(uint64_t file_bytes);

  void on_read(uint64_t offset, uint64_t bytes) override;
  void on_key_plane(uint64_t samples) override { key_samples_ += samples; }

  uint64_t bytes() const;
  uint64_t key_samples() const { return key_samples_; }
  void reset();

 private:
  std::vector<uint64_t> lines_;  // one bit a line
  std::atomic<uint64_t> key_samples_ = 0;
};

}  // namespace hmlfc
