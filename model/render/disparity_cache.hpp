// The disparity maps that frames with geometry look up, kept between frames within a budget.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <unordered_map>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/disparity.hpp>

#include "render/block_bits.hpp"

namespace hmlfc {

struct StreamView;

/// The disparity map of one view. It is read in pages of rows, each when one of its blocks is first
/// looked up. Thread-safe.
class ViewDisparities {
 public:
  ViewDisparities(const StreamView& stream, ViewPos view);

  /// What block (`bx`, `by`) of plane Y tells, of confidence 0 where it has an error; notes that
  /// the frame looks it up (SRF-5).
  const BlockDisparity& look_up(uint32_t bx, uint32_t by) {
    looked_up.set(bx, by);
    Page& page = pages_[by / kPageBlockRows];
    const BlockDisparity* blocks = page.blocks.load(std::memory_order_acquire);
    if (blocks == nullptr) blocks = read(page, by / kPageBlockRows * kPageBlockRows);
    return blocks[size_t{by % kPageBlockRows} * columns_ + bx];
  }

  BlockBits looked_up;                 ///< by the frame
  uint64_t frame = 0;                  ///< the last one that used the map
  std::atomic<size_t> bytes_read = 0;  ///< of pages in memory

 private:
  static constexpr uint32_t kPageBlockRows = 16;

  struct Page {
    std::atomic<const BlockDisparity*> blocks = nullptr;  // of `rows`, when they are there
    std::vector<BlockDisparity> rows;
  };

  // Reads the rows of `page` from `first` on, unless another thread has; returns its blocks.
  const BlockDisparity* read(Page& page, uint32_t first);

  const StreamView& stream_;
  ViewPos view_;
  uint32_t columns_;
  uint32_t rows_;
  std::vector<Page> pages_;
  std::mutex reading_;
};

/// Disparity maps of one light field. Over its budget it drops those that a frame did not use.
class DisparityCache {
 public:
  /// `decoder` must outlive it; `budget` in bytes.
  DisparityCache(const Decoder& decoder, size_t budget);

  /// Begins a frame, which looks up nothing yet.
  void begin_frame();

  /// The map of `view`, which the frame uses. Several threads may call this at once.
  ViewDisparities& use(ViewPos view);

  /// The number of blocks that the frame has looked up.
  uint64_t blocks_looked_up() const;

  /// Ends a frame: keeps the maps that it used, and others within the budget.
  void end_frame();

 private:
  const Decoder& decoder_;
  size_t budget_;
  uint64_t frame_ = 0;
  std::shared_mutex mutex_;
  std::unordered_map<uint64_t, std::unique_ptr<ViewDisparities>> views_;
};

}  // namespace hmlfc
