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

// The pixels of a run at which the blocks change that it reads in one column, or row, of views.
struct BlockSteps {
  std::vector<int32_t> at;  // pixels of the run, the first always
  const int32_t* first = nullptr;
  const int32_t* fraction = nullptr;
  unsigned log2 = 0;

  uint32_t first_block(int32_t i) const { return static_cast<uint32_t>(first[i]) >> log2; }
  uint32_t last_block(int32_t i) const {
    return static_cast<uint32_t>(first[i] + (fraction[i] != 0 ? 1 : 0)) >> log2;
  }

  void find(const AxisRun& axis, int32_t view, const RayRun& run, unsigned block_log2) {
    first = axis.first[view].data();
    fraction = axis.fraction[view].data();
    log2 = block_log2;
    at.resize(static_cast<size_t>(run.end - run.begin) + 1);
    at.resize(static_cast<size_t>(find_steps(first, fraction, run, log2, at.data())));
  }
};

// A row of blocks, gathered before it is added to those of a view.
class BlockRow {
 public:
  explicit BlockRow(uint32_t columns) : words_((columns + 63) / 64) {}

  void set(uint32_t bx) { words_[bx / 64] |= uint64_t{1} << (bx % 64); }

  // The words that hold blocks [first, last].
  std::span<uint64_t> words(uint32_t first, uint32_t last) {
    return std::span(words_).subspan(first / 64, last / 64 - first / 64 + 1);
  }

 private:
  std::vector<uint64_t> words_;
};

// Adds to `needed` the blocks of one view that a run reads: for each part of the run within one row
// of blocks, or two, those of the columns `x`. `row` is empty before and after.
void mark(const BlockSteps& x, const BlockSteps& y, int32_t run_end, BlockRow& row,
          BlockBits& needed) {
  size_t next = 0;  // of x.at, the first in or after the part
  for (size_t k = 0; k < y.at.size(); ++k) {
    const int32_t begin = y.at[k];
    const int32_t end = k + 1 < y.at.size() ? y.at[k + 1] : run_end;
    uint32_t least = x.first_block(begin);
    uint32_t most = x.last_block(begin);
    row.set(least);
    row.set(most);
    for (; next < x.at.size() && x.at[next] < end; ++next) {
      if (x.at[next] < begin) continue;
      const uint32_t first = x.first_block(x.at[next]);
      const uint32_t last = x.last_block(x.at[next]);
      row.set(first);
      row.set(last);
      least = std::min(least, first);
      most = std::max(most, last);
    }
    const auto words = row.words(least, most);
    for (uint32_t by = y.first_block(begin); by <= y.last_block(begin); ++by) {
      needed.set_words(by, least / 64, words);
    }
    std::fill(words.begin(), words.end(), uint64_t{0});
  }
}

// Plans rows for one task.
class RowPlanner {
 public:
  RowPlanner(const FrameRecord& record, int stop_level, const StreamHeader& header,
             ViewCache& cache)
      : record_(record),
        block_log2_(header.block_log2),
        views_(cache, header, stop_level),
        rays_(static_cast<size_t>(record.frame_width)),
        taps_(static_cast<size_t>(record.frame_width)),
        row_(cache.shape().blocks_x) {}

  // Returns the number of pixels of views that row `j` reads.
  uint64_t plan(int32_t j) {
    uint64_t reads = 0;
    trace_row(record_, j, rays_);
    for_each_run(record_, rays_, [&](const RayRun& run) {
      find_taps(record_, rays_, run, taps_);
      mark_run(run);
      reads += count_reads(run, taps_);
    });
    return reads;
  }

 private:
  void mark_run(const RayRun& run) {
    for (int32_t k = 0; k < taps_.cols.views; ++k) {
      x_[k].find(taps_.cols, k, run, block_log2_);
    }
    for (int32_t k = 0; k < taps_.rows.views; ++k) {
      y_.find(taps_.rows, k, run, block_log2_);
      for (int32_t m = 0; m < taps_.cols.views; ++m) {
        mark(x_[m], y_, run.end, row_, views_.at(run.first_row + k, run.first_col + m).needed);
      }
    }
  }

  const FrameRecord& record_;
  unsigned block_log2_;
  ViewLookup views_;
  RowRays rays_;
  RunTaps taps_;
  BlockSteps x_[kMaxAxisViews];
  BlockSteps y_;
  BlockRow row_;
};

}  // namespace

uint64_t plan_frame(const FrameRecord& record, int stop_level, const StreamHeader& header,
                    ViewCache& cache) {
  std::atomic<uint64_t> reads = 0;
  const auto rows = static_cast<size_t>(record.frame_height);
  parallel_for_parts(rows, kTaskRows, [&](size_t begin, size_t end) {
    RowPlanner planner(record, stop_level, header, cache);
    uint64_t part_reads = 0;
    for (size_t j = begin; j < end; ++j) part_reads += planner.plan(static_cast<int32_t>(j));
    reads += part_reads;
  });
  return reads * 3;
}

}  // namespace hmlfc
