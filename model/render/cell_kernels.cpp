#include "render/cell_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cell_kernels.cpp"
#include <hwy/foreach_target.h>  // before highway.h

#include <hwy/highway.h>

#include "render/taps.hpp"

HWY_BEFORE_NAMESPACE();
namespace hmlfc {
namespace HWY_NAMESPACE {

// The loops are plain: the compiler vectorises them.

// displacement_of().
HWY_INLINE int32_t displacement_by(int32_t told, int32_t focus, int32_t fine) {
  constexpr int32_t kLeast = -(1 << 15);
  constexpr int32_t kGreatest = (1 << 15) - 1;
  const int32_t seen = told > -fine && told < fine ? 0 : told;
  const int32_t e = (told == kNoDisparity ? focus : seen) - focus;
  return e < kLeast ? kLeast : e > kGreatest ? kGreatest : e;
}

// Input of locate_axis along one axis: coordinates `base` of RAY-4, with `step` for each view from
// view `origin`, and places among the views, of which `view` is one.
struct LocatedAxis {
  const int32_t* base;
  const int32_t* place;
  int32_t step;
  int32_t origin;
  int32_t size;
  int32_t pitch;
  int32_t view;
};

// The blocks along one axis.
inline void locate_axis(const LocatedAxis& axis, const RayRun& run, int32_t focus, int32_t fine,
                        unsigned log2, const int32_t* HWY_RESTRICT told,
                        int32_t* HWY_RESTRICT blocks) {
  const int32_t* HWY_RESTRICT base = axis.base;
  const int32_t* HWY_RESTRICT place = axis.place;
  const int32_t offset = axis.step * (axis.view - axis.origin);
  const int32_t at = axis.view * (1 << 12);
  const int32_t last = (axis.size - 1) << 12;
  const int32_t pitch = axis.pitch;
  const auto shift = static_cast<int32_t>(12 + log2);
  for (int32_t i = run.begin; i < run.end; ++i) {
    const int32_t g = (displacement_by(told[i], focus, fine) * pitch + (1 << 7)) >> 8;
    const int32_t x = base[i] + offset + ((g * (at - (place[i] >> 4))) >> 8);
    blocks[i] = ((x < 0 ? 0 : x > last ? last : x) + kHalfPixel) >> shift;
  }
}

inline void locate_here(const FrameRecord& f, const RowRays& rays, const RayRun& run, ViewPos view,
                        unsigned log2, const int32_t* told, CellBlocks& blocks) {
  constexpr int32_t kColumns = 1 << 8;  // the pitch of columns
  const LocatedAxis x{rays.xb.data(),
                      rays.us.data(),
                      f.dx,
                      f.c0,
                      f.width,
                      kColumns,
                      static_cast<int32_t>(view.col)};
  const LocatedAxis y{rays.yb.data(),
                      rays.vs.data(),
                      f.dy,
                      f.r0,
                      f.height,
                      f.pitch,
                      static_cast<int32_t>(view.row)};
  locate_axis(x, run, f.focus, f.fine, log2, told, blocks.bx.data());
  locate_axis(y, run, f.focus, f.fine, log2, told, blocks.by.data());
}

// Answers of one view of a run: as ToldByViews, with the weights of its column and row.
struct ViewWords {
  const int32_t* told;
  const int32_t* col_weight;
  const int32_t* row_weight;
};

// Proposals::chosen() of kViews views.
template <size_t kViews>
inline void choose(const std::array<ViewWords, Proposals::kMost>& views, const RayRun& run,
                   int32_t focus, int32_t fine, int32_t* HWY_RESTRICT cells) {
  for (int32_t i = run.begin; i < run.end; ++i) {
    int32_t e[kViews];
    int32_t weight[kViews];
    for (size_t k = 0; k < kViews; ++k) {
      e[k] = displacement_by(views[k].told[i], focus, fine);
      weight[k] = views[k].col_weight[i] * views[k].row_weight[i];
    }
    int32_t median = INT32_MAX;
    for (size_t k = 0; k < kViews; ++k) {
      int32_t up_to = 0;
      for (size_t m = 0; m < kViews; ++m) up_to += e[m] <= e[k] ? weight[m] : 0;
      const int32_t enough = up_to >= Proposals::kHalf ? e[k] : INT32_MAX;
      median = enough < median ? enough : median;
    }
    int32_t agreeing = 0;
    for (size_t k = 0; k < kViews; ++k) {
      const int32_t apart = e[k] - median;
      agreeing += (apart < 0 ? -apart : apart) <= Proposals::kAgreeing ? weight[k] : 0;
    }
    cells[i] = agreeing >= Proposals::kEnough ? median : 0;
  }
}

inline void choose_here(const FrameRecord& f, const RayRun& run, const RunTaps& weights,
                        const ToldByViews& told, int32_t* cells) {
  std::array<ViewWords, Proposals::kMost> views{};
  size_t count = 0;
  for (int32_t row = 0; row < weights.rows.views; ++row) {
    for (int32_t col = 0; col < weights.cols.views; ++col) {
      views[count] = {told[count].data(), weights.cols.weight[col].data(),
                      weights.rows.weight[row].data()};
      ++count;
    }
  }
  switch (count) {
    case 1:
      return choose<1>(views, run, f.focus, f.fine, cells);
    case 2:
      return choose<2>(views, run, f.focus, f.fine, cells);
    default:
      return choose<4>(views, run, f.focus, f.fine, cells);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace hmlfc {

HWY_EXPORT(locate_here);
HWY_EXPORT(choose_here);

void locate_blocks(const FrameRecord& record, const RowRays& rays, const RayRun& run, ViewPos view,
                   unsigned log2, const std::vector<int32_t>& told, CellBlocks& blocks) {
  HWY_DYNAMIC_DISPATCH(locate_here)(record, rays, run, view, log2, told.data(), blocks);
}

void choose_displacements(const FrameRecord& record, const RayRun& run, const RunTaps& weights,
                          const ToldByViews& told, int32_t* cells) {
  HWY_DYNAMIC_DISPATCH(choose_here)(record, run, weights, told, cells);
}

}  // namespace hmlfc

#endif  // HWY_ONCE
