// The decoded blocks that a frame keeps for the next ones.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "decode/batch.hpp"
#include "device/arguments.hpp"
#include "device/buffer.hpp"

namespace hmlfc::gpu {

/// The samples of blocks in pages, each with a slot for every block of a word of bits
/// (shaders/block_bits.glsl), and which blocks are held. The kernels of a frame say what is held
/// and where.
class BlockPool {
 public:
  /// For frames of up to `words` words of bits; pages of up to `budget` bytes are kept between
  /// them.
  BlockPool(const BlockSizes& sizes, uint64_t words, uint64_t budget);

  /// Makes room for `pages` pages, or for those that may be kept, and more than before where it
  /// makes some: a camera that needs ever more must not come back each frame. Nothing is held where
  /// there was less room. The device must not be using the pool. Throws MachineError beyond what a
  /// frame may take.
  void reserve(Device::State& device, uint64_t pages);

  /// Sets its part of `frame`, after reserve().
  void describe(FrameArguments& frame) const;

  /// Returns whether the pool is in more than one buffer.
  bool chunked() const { return samples_->chunked(); }

  /// Says that what is held must not be used any more.
  void forget() { forget_ = true; }

  /// FrameArguments::forget of the next frame: whether forget() was called since the last one.
  /// Without it the device forgets after a frame with an error, and before one of another level.
  uint32_t take_forget() { return std::exchange(forget_, false) ? 1 : 0; }

 private:
  uint64_t words_;
  uint64_t page_words_;
  uint64_t kept_pages_;
  uint64_t pages_ = 0;
  std::optional<ChunkedWords> samples_;
  GrowingBuffer held_{Memory::kDevice};
  GrowingBuffer page_numbers_{Memory::kDevice};
  GrowingBuffer used_pages_{Memory::kDevice};  // and the level of what is held
  bool forget_ = false;
};

}  // namespace hmlfc::gpu
