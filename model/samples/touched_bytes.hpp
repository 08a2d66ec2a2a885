// How much of a stream is read.
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/decoder.hpp>

namespace hmlfc {

/// The bytes that were read since the last call of reset(), each counted once, in whole lines of
/// kLineBytes as memory fetches them.
class TouchedBytes final : public ReadSink {
 public:
  static constexpr uint64_t kLineBytes = 64;

  /// For a file of at most `file_bytes` bytes.
  explicit TouchedBytes(uint64_t file_bytes);

  void on_read(uint64_t offset, uint64_t bytes) override;

  uint64_t bytes() const;
  void reset();

 private:
  std::vector<uint64_t> lines_;  // one bit a line
};

}  // namespace hmlfc
