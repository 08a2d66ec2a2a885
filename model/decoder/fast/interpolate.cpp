// Plain loops over fixed numbers of columns, which the compiler vectorises for each instruction
// set; one is chosen at run time.
#include "decoder/fast/interpolate.hpp"

#include <cstring>
#include <limits>

#include "arithmetic/motion.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "decoder/fast/interpolate.cpp"
#include <hwy/foreach_target.h>  // before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hmlfc {
namespace HWY_NAMESPACE {

// One reference from a column on; for samples of weight 0 any that can be read are taken.
struct Taps {
  Taps(const DisplacedReference& reference, unsigned x)
      : row(reference.view.data + x),
        stride(reference.view.stride),
        right(reference.fx == 0 ? 0 : 1),
        below(reference.fy == 0 ? 0 : reference.view.stride),
        weights(tap_weights<int16_t>(reference.fx, reference.fy)) {}

  const int16_t* row;
  size_t stride;
  size_t right;  // to the samples of weight fx
  size_t below;  // to the samples of weight fy
  std::array<int16_t, 4> weights;
};

// I of MOT-9 in kLanes columns of one row. Sum holds it and its partial sums: all lie in
// 64 * [-bound, bound].
template <class Sum, unsigned kLanes>
inline void sum_row(const Taps& taps, const int16_t* row, Sum (&sums)[kLanes]) {
  int16_t s00[kLanes], s10[kLanes], s01[kLanes], s11[kLanes];
  std::memcpy(s00, row, sizeof(s00));
  std::memcpy(s10, row + taps.right, sizeof(s10));
  std::memcpy(s01, row + taps.below, sizeof(s01));
  std::memcpy(s11, row + taps.below + taps.right, sizeof(s11));
  const auto [w00, w10, w01, w11] = taps.weights;
  for (unsigned i = 0; i < kLanes; ++i) {
    sums[i] = static_cast<Sum>(s00[i] * w00 + s10[i] * w10 + s01[i] * w01 + s11[i] * w11);
  }
}

// Columns [x, x + kLanes).
template <class Sum, unsigned kLanes>
void put_columns(const DisplacedReference& reference, const PredictionTarget& target, unsigned x) {
  const Taps taps(reference, x);
  for (unsigned y = 0; y < target.rows; ++y) {
    Sum sums[kLanes];
    int16_t values[kLanes];
    sum_row(taps, taps.row + y * taps.stride, sums);
    for (unsigned i = 0; i < kLanes; ++i) {
      values[i] = static_cast<int16_t>(one_reference_value(sums[i]));
    }
    std::memcpy(target.data + y * target.stride + x, values, sizeof(values));
  }
}

template <class Sum, unsigned kLanes>
void put_columns(const std::array<DisplacedReference, 2>& references,
                 const PredictionTarget& target, unsigned x) {
  const Taps first(references[0], x);
  const Taps second(references[1], x);
  for (unsigned y = 0; y < target.rows; ++y) {
    Sum a[kLanes], b[kLanes];
    int16_t values[kLanes];
    sum_row(first, first.row + y * first.stride, a);
    sum_row(second, second.row + y * second.stride, b);
    for (unsigned i = 0; i < kLanes; ++i) {
      values[i] = static_cast<int16_t>(two_reference_value(a[i], b[i]));
    }
    std::memcpy(target.data + y * target.stride + x, values, sizeof(values));
  }
}

// Columns that go together at most.
constexpr unsigned kWidest = 32;

// Columns [x, columns): kLanes at a time, and what is left half as many at a time.
template <class Sum, unsigned kLanes, class References>
void interpolate(const References& references, const PredictionTarget& target, unsigned x = 0) {
  for (; x + kLanes <= target.columns; x += kLanes) {
    put_columns<Sum, kLanes>(references, target, x);
  }
  if constexpr (kLanes > 1) interpolate<Sum, kLanes / 2>(references, target, x);
}

// R of whole vectors: the reference itself, or the mean of two, halves up.
inline void average(const std::array<DisplacedReference, 2>& references, unsigned count,
                    const PredictionTarget& target) {
  for (unsigned y = 0; y < target.rows; ++y) {
    int16_t* out = target.data + y * target.stride;
    const int16_t* first = references[0].view.data + y * references[0].view.stride;
    if (count == 1) {
      std::memcpy(out, first, target.columns * sizeof(int16_t));
      continue;
    }
    const int16_t* second = references[1].view.data + y * references[1].view.stride;
    for (unsigned x = 0; x < target.columns; ++x) {
      out[x] = static_cast<int16_t>((first[x] + second[x] + 1) >> 1);
    }
  }
}

inline bool is_whole(const DisplacedReference& reference) {
  return reference.fx == 0 && reference.fy == 0;
}

void interpolate_rect_here(const std::array<DisplacedReference, 2>& references, unsigned count,
                           int32_t bound, const PredictionTarget& target) {
  if (is_whole(references[0]) && (count == 1 || is_whole(references[1]))) {
    return average(references, count, target);
  }
  const auto most = static_cast<int32_t>(count) * (64 * bound + 32);
  const bool narrow = most <= std::numeric_limits<int16_t>::max();
  if (count == 1) {
    narrow ? interpolate<int16_t, kWidest>(references[0], target)
           : interpolate<int32_t, kWidest>(references[0], target);
  } else {
    narrow ? interpolate<int16_t, kWidest>(references, target)
           : interpolate<int32_t, kWidest>(references, target);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace hmlfc {

HWY_EXPORT(interpolate_rect_here);

void interpolate_rect(const std::array<DisplacedReference, 2>& references, unsigned count,
                      int32_t bound, const PredictionTarget& target) {
  HWY_DYNAMIC_DISPATCH(interpolate_rect_here)(references, count, bound, target);
}

}  // namespace hmlfc

#endif  // HWY_ONCE
