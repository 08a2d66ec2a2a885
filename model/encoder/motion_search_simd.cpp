// The fast motion search, compiled once for each instruction set and chosen at run time.
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encoder/motion_search_simd.cpp"
#include <hwy/foreach_target.h>  // before highway.h

#include <hwy/highway.h>

#include "encoder/motion_search_kernel-inl.hpp"
#include "encoder/motion_search_request.hpp"

HWY_BEFORE_NAMESPACE();
namespace hmlfc {
namespace HWY_NAMESPACE {

// Groups of candidates whose bounds are computed before the first of them is evaluated. More: fewer
// mispredicted branches. Fewer: the bounds are compared with a better match.
constexpr int kGroupsPerPass = 16;

/// One search: the window cut into groups of candidates, as many as a vector has lanes.
template <int kSize, bool kBothSigns>
class MotionSearch {
  using Kernel = MotionKernel<kSize, kBothSigns>;

 public:
  explicit MotionSearch(const MotionRequest& request)
      : kernel_(request), request_(request), side_(2 * request.window + 1) {
    const int tail = side_ % lanes_;
    const int column_groups = tail * ((side_ + lanes_ - 1) / lanes_);
    columns_ = 2 * column_groups < side_ ? tail : 0;
    if (columns_ > 0) {
      copy_columns();
    }
  }

  /// Tries (0, 0), the hints, then all candidates. Not found(): each has a sad above kLargestSad.
  MotionBest run() {
    try_around(0, 0);
    for (size_t k = 0; k < request_.hint_count; ++k) {
      try_around(request_.hints[k].dx, request_.hints[k].dy);
    }
    search_rows();
    for (int k = 0; k < columns_; ++k) {
      search_column(k);
    }
    return best_;
  }

 private:
  struct Start {
    int16_t dx;
    int16_t dy;
  };

  // Tries (dx, dy), if it lies in the window, and some of its neighbours to the left and the right.
  void try_around(int dx, int dy) {
    const int window = request_.window;
    if (dx >= -window && dx <= window && dy >= -window && dy <= window) {
      const int last = HWY_MAX(-window, window + 1 - lanes_);
      try_row_group(HWY_MAX(-window, HWY_MIN(dx - lanes_ / 2, last)), dy);
    }
  }

  HWY_INLINE void try_row_group(int dx, int dy) {
    const MotionGroup group{.dx = dx,
                            .dy = dy,
                            .step_x = 1,
                            .step_y = 0,
                            .count = HWY_MIN(lanes_, request_.window - dx + 1),
                            .least_length = dy < 0 ? -dy : dy};
    const int16_t* r = request_.reference + dy * request_.stride + dx;
    kernel_.template evaluate<false>(r, request_.stride, 1, group, best_);
  }

  // The k-th row from the middle outwards: 0, 1, -1, 2, -2 ...
  static int row_from_middle(int k) { return k % 2 != 0 ? (k + 1) / 2 : -(k / 2); }

  // The rows, without the columns that search_column() does.
  void search_rows() {
    Start starts[kGroupsPerPass];
    int count = 0;
    uint32_t kept = 0;  // bit k: starts[k] may hold something better
    const int end = request_.window + 1 - columns_;
    for (int k = 0; k < side_; ++k) {
      const int dy = row_from_middle(k);
      const int64_t limit = HWY_MIN(best_.limit(dy < 0 ? -dy : dy), Kernel::kLargestSad);
      if (limit < 0) {
        continue;
      }
      for (int dx = -request_.window; dx < end; dx += lanes_) {
        const bool keep = may_reach(dx, dy, end - dx, limit);
        starts[count] = {static_cast<int16_t>(dx), static_cast<int16_t>(dy)};
        kept |= uint32_t{keep} << count;
        if (++count == kGroupsPerPass) {
          evaluate_kept(starts, kept);
          count = 0;
          kept = 0;
        }
      }
    }
    evaluate_kept(starts, kept);
  }

  HWY_INLINE bool may_reach(int dx, int dy, int count, int64_t limit) const {
    if constexpr (Kernel::kHasBound) {
      const int16_t* r = request_.square_sums + dy * request_.stride + dx;
      return kernel_.may_reach(r, request_.stride, count, limit);
    }
    return true;
  }

  HWY_INLINE void evaluate_kept(const Start* starts, uint32_t kept) {
    while (kept != 0) {
      const Start& start = starts[hwy::Num0BitsBelowLS1Bit_Nonzero32(kept)];
      kept &= kept - 1;
      try_row_group(start.dx, start.dy);
    }
  }

  // A transposed copy of the samples that the rightmost columns_ columns of candidates cover. Done
  // long before search_column() reads it: a vector load of freshly stored single samples stalls.
  void copy_columns() {
    const int width = columns_ + request_.block_size - 1;
    const int height = side_ + request_.block_size - 1;
    const int left = request_.window + 1 - columns_;
    for (int x = 0; x < width; ++x) {
      const int16_t* r = request_.reference - request_.window * request_.stride + left + x;
      for (int y = 0; y < height; ++y) {
        transposed_[x][y] = r[y * request_.stride];
      }
    }
  }

  // All candidates of the k-th of the rightmost columns_ columns.
  void search_column(int k) {
    const int dx = request_.window + 1 - columns_ + k;
    for (int first = 0; first < side_; first += lanes_) {
      const MotionGroup group{.dx = dx,
                              .dy = first - request_.window,
                              .step_x = 0,
                              .step_y = 1,
                              .count = HWY_MIN(lanes_, side_ - first),
                              .least_length = dx < 0 ? -dx : dx};
      kernel_.template evaluate<true>(transposed_[k] + first, 1, kTransposedHeight, group, best_);
    }
  }

  // columns_ is less than lanes_ / 2, and a vector reads at most kReadAhead samples too far.
  static constexpr int kTransposedWidth =
      ReferencePlane::kReadAhead / 2 + ReferencePlane::kMaxBlock;
  static constexpr int kTransposedHeight =
      2 * ReferencePlane::kMaxWindow + ReferencePlane::kMaxBlock + ReferencePlane::kReadAhead;

  const Kernel kernel_;
  const MotionRequest& request_;
  MotionBest best_;
  const int lanes_ = Kernel::lanes();
  const int side_;  // candidates in a row and in a column
  int columns_;     // columns at the right that are searched downwards: too few to fill a vector
  int16_t transposed_[kTransposedWidth][kTransposedHeight];
};

template <int kSize>
MotionBest search_size(const MotionRequest& request) {
  return request.both_signs ? MotionSearch<kSize, true>(request).run()
                            : MotionSearch<kSize, false>(request).run();
}

MotionBest search_request(const MotionRequest& request) {
  switch (request.block_size) {
    case 2:
      return search_size<2>(request);
    case 4:
      return search_size<4>(request);
    default:
      return search_size<8>(request);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace hmlfc {

HWY_EXPORT(search_request);

MotionMatch search_motion(std::span<const int16_t> block, int block_size, uint32_t x, uint32_t y,
                          const ReferencePlane& reference, int window, bool both_signs,
                          std::span<const MotionMatch> hints) {
  assert(block_size == 2 || block_size == 4 || block_size == 8);
  assert(block.size() == static_cast<size_t>(block_size * block_size));
  assert(x < reference.width() && y < reference.height());
  assert(window >= 0 && window <= reference.max_window());
  const MotionBest best = HWY_DYNAMIC_DISPATCH(search_request)({
      .block = block.data(),
      .reference = reference.sample(x, y),
      .square_sums = reference.square_sum(x, y),
      .stride = reference.stride(),
      .block_size = block_size,
      .window = window,
      .both_signs = both_signs,
      .hints = hints.data(),
      .hint_count = hints.size(),
  });
  if (best.found()) return best.match();
  // Nothing in the window resembles the block, whose samples have more than 8 bits.
  return search_motion_brute_force(block, block_size, x, y, reference, window, both_signs);
}

}  // namespace hmlfc

#endif  // HWY_ONCE
