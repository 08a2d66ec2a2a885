// Memory of the device, addressed by 64 bits: buffers, and words that several buffers hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "device_state.hpp"
#include "guarded_pages.hpp"

namespace hmlfc::gpu {

/// A piece of the program's memory.
class BorrowedMemory {
 public:
  /// Throws vk::OutOfDeviceMemoryError where the program has none.
  BorrowedMemory(const MemoryCallbacks& callbacks, const VkMemoryRequirements& needs,
                 vk::MemoryPropertyFlags required, vk::MemoryPropertyFlags preferred);
  BorrowedMemory(BorrowedMemory&& other) noexcept;
  BorrowedMemory& operator=(BorrowedMemory&&) = delete;
  ~BorrowedMemory();

  const MemoryPiece& piece() const { return piece_; }

 private:
  MemoryCallbacks callbacks_;  // without functions after a move
  MemoryPiece piece_;
};

enum class Memory : uint8_t {
  kDevice,    ///< for kernels; reached by copies
  kUpload,    ///< written by the host, read by kernels and copies
  kReadback,  ///< written by copies, read by the host
};

/// One buffer with its memory. Throws MachineError where the device has no such memory.
class Buffer {
 public:
  /// Makes a buffer of `bytes` bytes, rounded up to a multiple of 4, at least 4.
  Buffer(Device::State& device, uint64_t bytes, Memory memory);

  Buffer(Buffer&&) noexcept = default;
  Buffer& operator=(Buffer&&) = delete;
  ~Buffer() { device_->settle(); }

  uint64_t size() const { return size_; }
  uint64_t address() const { return address_; }
  vk::Buffer handle() const { return *buffer_; }

  /// The bytes as the host sees them; empty for device memory.
  std::span<uint8_t> bytes() const { return {mapped_, mapped_ == nullptr ? 0 : size_}; }

  template <class Record>
  std::span<Record> records() const {
    return {reinterpret_cast<Record*>(mapped_), size_ / sizeof(Record)};
  }

 private:
  void allocate(Device::State& device, const vk::MemoryRequirements& needs, Memory memory);
  void allocate_guarded(Device::State& device, const vk::MemoryRequirements& needs);

  Device::State* device_;
  uint64_t size_;
  std::optional<GuardedPages> pages_;
  std::optional<BorrowedMemory> borrowed_;
  vk::raii::DeviceMemory memory_;
  vk::raii::Buffer buffer_;
  uint8_t* mapped_ = nullptr;
  uint64_t address_ = 0;
};

/// A buffer that grows.
class GrowingBuffer {
 public:
  explicit GrowingBuffer(Memory memory) : memory_(memory) {}

  /// Returns at least `bytes` bytes. Their content is lost where the buffer grows.
  Buffer& reserve(Device::State& device, uint64_t bytes) {
    if (!buffer_ || buffer_->size() < bytes) {
      buffer_.reset();
      buffer_ = std::make_unique<Buffer>(device, bytes, memory_);
    }
    return *buffer_;
  }

  const Buffer& get() const { return *buffer_; }

 private:
  Memory memory_;
  std::unique_ptr<Buffer> buffer_;
};

/// Returns the bytes of records as they lie in memory.
template <class Records>
std::span<const uint8_t> bytes_of(const Records& records) {
  const auto bytes = std::as_bytes(std::span(records));
  return {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
}

/// Writes `bytes`, a multiple of 4 of them, to the beginning of device memory; waits until it is
/// done.
void upload(Device::State& device, std::span<const uint8_t> bytes, const Buffer& to);

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

  /// Returns what a kernel takes: the address of the table of chunks, or of the only chunk.
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
