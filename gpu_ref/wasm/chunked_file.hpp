// The file of a stream in a browser, of which the page loads chunks.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <hmlfc/byte_source.hpp>

namespace hmlfc::gpu {

/// Reads of what is not loaded are noted and fail.
class ChunkedFile final : public ByteSource {
 public:
  static constexpr uint64_t kChunkBytes = 1 << 12;

  /// room() is null where there is no memory for `bytes` bytes. Its pages are new ones, which take
  /// up nothing until bytes come, however many the host says that there are; it stays.
  explicit ChunkedFile(size_t bytes) : bytes_(bytes), loaded_(bytes / kChunkBytes + 1) {
    const size_t page = __builtin_wasm_memory_grow(0, (bytes >> 16) + 1);
    room_ = page == SIZE_MAX ? nullptr : reinterpret_cast<uint8_t*>(page << 16);
  }
  ChunkedFile(const ChunkedFile&) = delete;
  ChunkedFile& operator=(const ChunkedFile&) = delete;

  uint8_t* room() { return room_; }

  /// The chunk that begins at `offset` has been written to room().
  void set_loaded(uint64_t offset) { loaded_[static_cast<size_t>(offset / kChunkBytes)] = true; }

  std::span<const uint8_t> bytes() const override { return {room_, bytes_}; }
  bool is_partial() const override { return true; }

  bool holds(ByteRange range) const override {
    if (range.offset > bytes_ || range.bytes > bytes_ - range.offset) return false;
    if (range.bytes == 0) return true;
    const uint64_t last = (range.offset + range.bytes - 1) / kChunkBytes;
    for (uint64_t chunk = range.offset / kChunkBytes; chunk <= last; ++chunk) {
      if (!loaded_[static_cast<size_t>(chunk)]) return false;
    }
    return true;
  }

  bool load(std::span<const ByteRange> ranges) override {
    missing_.insert(missing_.end(), ranges.begin(), ranges.end());
    return false;
  }

  std::vector<ByteRange> take_missing() { return std::exchange(missing_, {}); }

 private:
  size_t bytes_;
  uint8_t* room_ = nullptr;
  std::vector<bool> loaded_;
  std::vector<ByteRange> missing_;
};

}  // namespace hmlfc::gpu
