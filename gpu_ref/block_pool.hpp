// The decoded blocks that frames leave to the next one.
#pragma once

#include <cstdint>
#include <optional>

#include "batch_buffers.hpp"
#include "buffer.hpp"
#include "frame_shape.hpp"

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

  /// Writes its part of `shape`, after reserve().
  void describe(FrameShape& shape) const;

  /// The pool is in more than one buffer.
  bool chunked() const { return samples_->chunked(); }

  /// A frame of level `stop_level` is submitted: whether it must forget what is held, since that is
  /// of another level. The device itself forgets after a frame with an error.
  bool begin_frame(int stop_level) {
    const bool forgets = held_level_ != stop_level;
    held_level_ = stop_level;
    return forgets;
  }

  void forget() { held_level_.reset(); }

 private:
  uint64_t words_;
  uint64_t page_words_;
  uint64_t kept_pages_;
  uint64_t pages_ = 0;
  std::optional<ChunkedWords> samples_;
  GrowingBuffer held_{Memory::kDevice};
  GrowingBuffer page_numbers_{Memory::kDevice};
  GrowingBuffer used_pages_{Memory::kDevice};
  std::optional<int> held_level_;
};

}  // namespace hmlfc::gpu
