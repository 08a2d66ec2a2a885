// The disparity maps that frames with geometry look up, kept between frames within a budget.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include <hmlfc/decoder.hpp>

namespace hmlfc {

struct StreamView;

/// The disparity map of one view. It is read in pages of rows, each when one of its blocks is first
/// looked up. Several threads may look up at once.
class ViewDisparities {
 public:
  ViewDisparities(const StreamView& stream, ViewPos view);

  /// Writes to `told` what blocks (bx[i], by[i]) of plane Y tell, or kNoDisparity where that is
  /// nothing or an error; notes that the frame looks them up (SRF-5). All spans have one length.
  void look_up(std::span<const int32_t> bx, std::span<const int32_t> by, std::span<int32_t> told);

  /// Begins frame `number`, unless that has begun: it has looked up nothing yet, and reads
  /// `stream`.
  void begin_frame(uint64_t number, const StreamView& stream);

  /// Drops the pages read since the last keep_pages().
  void drop_pages();
  void keep_pages() { new_pages_.clear(); }

  uint64_t frame() const { return frame_; }  ///< the last one begun
  uint64_t blocks_looked_up() const;         ///< by that frame
  size_t bytes_read() const { return bytes_read_; }

 private:
  static constexpr uint32_t kPageBlockRows = 16;

  // The disparities of row `by`, read with its page unless another thread has.
  const int32_t* read(uint32_t by);

  const StreamView* stream_;
  ViewPos view_;
  uint32_t columns_;
  uint64_t frame_ = 0;
  std::vector<uint8_t> looked_up_;                 // by block; 1 or 0
  std::vector<std::atomic<const int32_t*>> rows_;  // null before they are read
  std::vector<std::vector<int32_t>> pages_;        // the rows of each page
  std::vector<uint32_t> new_pages_;
  std::atomic<size_t> bytes_read_ = 0;
  std::mutex reading_;
};

/// Disparity maps of one light field. Over its budget it drops those that a frame did not use.
class DisparityCache {
 public:
  /// `decoder` must outlive it; `budget` in bytes.
  DisparityCache(const Decoder& decoder, size_t budget);

  /// Begins a frame, which looks up nothing yet. It reads `stream`: that of the decoder, or one on
  /// trial (load_by_trials), for which a frame begins again: what it read before is dropped.
  void begin_frame(const StreamView& stream);

  /// The map of `view`, which the frame uses. Several threads may call this at once.
  ViewDisparities& use(ViewPos view);

  /// The number of blocks that the frame has looked up.
  uint64_t blocks_looked_up() const;

  /// Ends a frame: keeps what it read, the maps that it used, and others within the budget.
  void end_frame();

 private:
  const StreamView* stream_;
  size_t budget_;
  uint64_t frame_ = 0;
  std::shared_mutex mutex_;
  std::unordered_map<uint64_t, std::unique_ptr<ViewDisparities>> views_;
};

}  // namespace hmlfc
