// The decoded blocks that frames leave to the next one.
#pragma once

#include <cstdint>
#include <optional>

#include "batch_buffers.hpp"
#include "buffer.hpp"
#include "commands.hpp"
#include "frame_shape.hpp"

namespace hmlfc::gpu {

/// The samples of blocks in pages, each with a slot for every block of a word of bits
/// (shaders/block_bits.glsl), and which blocks are held. The kernels of a frame say what is held
/// and where; the host forgets it where that is not true of the next frame.
class BlockPool {
 public:
  /// For frames of up to `words` words of bits; pages of up to `budget` bytes are kept between
  /// them.
  BlockPool(const BlockSizes& sizes, uint64_t words, uint64_t budget);

  /// Makes room for `pages` pages, or for those that may be kept. Nothing is held where there was
  /// less room. Throws MachineError beyond what a frame may take.
  void reserve(Device::State& device, uint64_t pages);

  /// Writes its part of `shape`, after reserve().
  void describe(FrameShape& shape) const;

  /// The pool is in more than one buffer.
  bool chunked() const { return samples_->chunked(); }

  /// Begins a frame of level `stop_level`. Blocks of another level are forgotten; those of this
  /// frame too, unless end_frame() says that all of them have decoded.
  void begin_frame(int stop_level, Commands& commands, const Buffer& counters);
  void end_frame(int stop_level) { held_level_ = stop_level; }

  void forget() { held_level_.reset(); }

 private:
  uint64_t words_;
  uint64_t page_words_;
  uint64_t kept_pages_;
  uint64_t pages_ = 0;
  std::optional<ChunkedWords> samples_;
  GrowingBuffer held_{Memory::kDevice};
  GrowingBuffer page_numbers_{Memory::kDevice};
  std::optional<int> held_level_;
};

}  // namespace hmlfc::gpu
