#include "render/frame_stages.hpp"

#include <algorithm>
#include <atomic>
#include <span>
#include <vector>

#include "bits/parallel.hpp"
#include "render/row_kernels.hpp"

namespace hmlfc {
namespace {

// Rows of a task: at least those of a block, so that tasks rarely set the same bits.
constexpr size_t kTaskRows = 16;

// The blocks that a run reads along one axis in one column, or row, of views.
class AxisBlocks {
 public:
  explicit AxisBlocks(unsigned log2) : log2_(log2) {}

  void choose(const AxisRun& axis, int32_t view) {
    axis_ = &axis;
    view_ = view;
  }

  // Whether the blocks read by any part of the run are all those from its first pixel's to its last
  // one's: taps rise, or fall, by a block at most.
  void find_steady(const RayRun& run) { steady_ = is_steady(*axis_, view_, run, 1 << log2_); }
  bool steady() const { return steady_; }

  // Finds the pixels of the run at which the blocks change, the first always.
  void find_steps(const RayRun& run) {
    steps_.resize(static_cast<size_t>(run.end - run.begin) + 1);
    steps_.resize(static_cast<size_t>(hmlfc::find_steps(*axis_, view_, run, log2_, steps_.data())));
  }
  const std::vector<int32_t>& steps() const { return steps_; }

  // The blocks of pixel `i` of the run.
  uint32_t first(int32_t i) const {
    return static_cast<uint32_t>(axis_->first[view_][static_cast<size_t>(i)]) >> log2_;
  }
  uint32_t last(int32_t i) const { return static_cast<uint32_t>(axis_->last(view_, i)) >> log2_; }

 private:
  unsigned log2_;
  const AxisRun* axis_ = nullptr;
  int32_t view_ = 0;
  bool steady_ = false;
  std::vector<int32_t> steps_;
};

// A row of blocks, gathered before it is added to those of a view.
class BlockRow {
 public:
  explicit BlockRow(uint32_t columns) : words_((columns + 63) / 64) {}

  void set(uint32_t bx) { words_[bx / 64] |= uint64_t{1} << (bx % 64); }

  // Sets blocks [first, last].
  void set_range(uint32_t first, uint32_t last) {
    const auto range = words(first, last);
    std::fill(range.begin(), range.end(), ~uint64_t{0});
    range.front() &= ~uint64_t{0} << (first % 64);
    range.back() &= ~uint64_t{0} >> (63 - last % 64);
  }

  // The words that hold blocks [first, last].
  std::span<uint64_t> words(uint32_t first, uint32_t last) {
    return std::span(words_).subspan(first / 64, last / 64 - first / 64 + 1);
  }

 private:
  std::vector<uint64_t> words_;
};

// Adds to `needed` the blocks of one view that a run reads: for each part of the run within one row
// of blocks, or two, those of the columns `x`. `row` is empty before and after.
void mark(const AxisBlocks& x, const AxisBlocks& y, int32_t run_end, BlockRow& row,
          BlockBits& needed) {
  const std::vector<int32_t>& parts = y.steps();
  size_t next = 0;  // of x.steps(), the first in or after the part
  for (size_t k = 0; k < parts.size(); ++k) {
    const int32_t begin = parts[k];
    const int32_t end = k + 1 < parts.size() ? parts[k + 1] : run_end;
    uint32_t least = x.first(begin);
    uint32_t most = x.last(begin);
    const auto add = [&](int32_t i) {
      row.set(x.first(i));
      row.set(x.last(i));
      least = std::min(least, x.first(i));
      most = std::max(most, x.last(i));
    };
    if (x.steady()) {
      least = std::min(least, x.first(end - 1));
      most = std::max(most, x.last(end - 1));
      row.set_range(least, most);
    } else {
      add(begin);
      for (; next < x.steps().size() && x.steps()[next] < end; ++next) add(x.steps()[next]);
    }
    const auto words = row.words(least, most);
    for (uint32_t by = y.first(begin); by <= y.last(begin); ++by) {
      needed.set_words(by, least / 64, words);
    }
    std::fill(words.begin(), words.end(), uint64_t{0});
  }
}

// Plans rows for one task.
class RowPlanner {
 public:
  RowPlanner(const FrameRecord& record, int stop_level, const StreamHeader& header,
             const CellDisplacements& displaced, ViewCache& cache)
      : record_(record),
        displaced_(displaced),
        views_(cache, header, stop_level),
        rays_(static_cast<size_t>(record.frame_width)),
        taps_(static_cast<size_t>(record.frame_width)),
        x_(kMaxAxisViews, AxisBlocks(header.block_log2)),
        y_(header.block_log2),
        row_(cache.shape().blocks_x) {}

  // Returns the number of pixels of views that row `j` reads.
  uint64_t plan(int32_t j) {
    uint64_t reads = 0;
    trace_row(record_, row_of_pixels(record_, j), rays_);
    rays_.displace(displaced_, j);
    for (const RayRun& run : rays_.runs()) {
      find_taps(record_, rays_, run, taps_);
      mark_run(run);
      reads += count_reads(run, taps_);
    }
    return reads;
  }

 private:
  void mark_run(const RayRun& run) {
    const auto cols = static_cast<size_t>(taps_.cols.views);
    for (size_t m = 0; m < cols; ++m) {
      x_[m].choose(taps_.cols, static_cast<int32_t>(m));
      x_[m].find_steady(run);
      if (!x_[m].steady()) x_[m].find_steps(run);
    }
    for (int32_t k = 0; k < taps_.rows.views; ++k) {
      y_.choose(taps_.rows, k);
      y_.find_steps(run);
      for (size_t m = 0; m < cols; ++m) {
        const int32_t col = run.first_col + static_cast<int32_t>(m);
        mark(x_[m], y_, run.end, row_, views_.at(run.first_row + k, col).needed);
      }
    }
  }

  const FrameRecord& record_;
  const CellDisplacements& displaced_;
  ViewLookup views_;
  RowRays rays_;
  RunTaps taps_;
  std::vector<AxisBlocks> x_;
  AxisBlocks y_;
  BlockRow row_;
};

}  // namespace

uint64_t plan_frame(const FrameRecord& record, int stop_level, const StreamHeader& header,
                    const CellDisplacements& displaced, ViewCache& cache) {
  std::atomic<uint64_t> reads = 0;
  const auto rows = static_cast<size_t>(record.frame_height);
  parallel_for_parts(rows, kTaskRows, [&](size_t begin, size_t end) {
    RowPlanner planner(record, stop_level, header, displaced, cache);
    uint64_t part_reads = 0;
    for (size_t j = begin; j < end; ++j) part_reads += planner.plan(static_cast<int32_t>(j));
    reads += part_reads;
  });
  return reads * 3;
}

}  // namespace hmlfc
