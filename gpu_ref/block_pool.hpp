// A frame on the device: its arguments (shaders/frame.glsl), and the decoded blocks that frames
// leave to the next one.
#pragma once

#include <cstdint>
#include <optional>

#include <hmlfc/camera.hpp>

#include "batch_buffers.hpp"
#include "buffer.hpp"
#include "commands.hpp"

namespace hmlfc::gpu {

struct FrameShape {
  uint64_t needed = 0;
  uint64_t held = 0;
  uint64_t pages = 0;
  uint64_t slots = 0;
  uint64_t counters = 0;
  uint64_t dispatches = 0;
  uint64_t drawn = 0;
  uint64_t pool = 0;
  uint32_t pool_chunk_log2 = 0;
  uint32_t pool_pages = 0;
  uint32_t kept_pages = 0;
  uint32_t stop_level = 0;
  uint32_t capacity = 0;
  uint32_t needed_words = 0;
  FrameRecord record;
};

/// Words of the counters that the host uses.
enum FrameCounter : uint32_t {
  kCountNeeded = 0,
  kCountMode = 4,
  kCountDecoded = 5,
  kCountPages = 6,
  kCountFirstError = 9,
  kCountStatus = 10,
  kFrameCounters = 11,  ///< those before are of one frame
  kCountUsedPages = 11,
  kAllCounters = 12,
};

/// Words of the sizes of dispatches that plan.comp decides, three each.
enum FrameDispatch : uint32_t {
  kDispatchWalk = 0,
  kDispatchSamples = 3,
  kDispatchErrors = 6,
  kAllDispatches = 9,
};

inline constexpr uint32_t kModeNoRoom = 0;  ///< of kCountMode

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
