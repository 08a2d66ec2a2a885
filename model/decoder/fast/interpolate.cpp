// With vectors of the instruction set chosen at run time.
#include "decoder/fast/interpolate.hpp"

#include <cstdint>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "decoder/fast/interpolate.cpp"
#include <hwy/foreach_target.h>  // before highway.h

#include <hwy/cache_control.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hmlfc {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class D>
inline hn::Vec<D> load(D lanes, const int16_t* from) {
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(int16_t)) {
    return hn::LoadU(lanes, from);
  } else {
    return hn::PromoteTo(lanes, hn::LoadU(hn::Rebind<int16_t, D>(), from));
  }
}

template <class D>
inline void store(D lanes, hn::Vec<D> values, int16_t* to) {
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(int16_t)) {
    hn::StoreU(values, lanes, to);
  } else {
    const hn::Rebind<int16_t, D> words;
    hn::StoreU(hn::DemoteTo(words, values), words, to);
  }
}

// Bytes from what a row reads to what is fetched beside it, for the next piece: neighbours most
// often have nearly the same vector. That may lie outside the plane: a prefetch never faults.
constexpr uintptr_t kAhead = 128;

// One reference from column x on, row after row. The weights of MOT-9 are products, so each row is
// blended across once and serves two rows of sums.
template <class D>
struct Taps {
  using Lane = hn::TFromD<D>;

  Taps(const DisplacedReference& reference, unsigned x)
      : row(reference.view.data + x),
        stride(reference.view.stride),
        right(reference.fx == 0 ? 0 : 1),
        below(reference.fy == 0 ? 0 : reference.view.stride),
        fx(hn::Set(D(), static_cast<Lane>(reference.fx))),
        rest_x(hn::Set(D(), static_cast<Lane>(8 - reference.fx))),
        fy(hn::Set(D(), static_cast<Lane>(reference.fy))),
        rest_y(hn::Set(D(), static_cast<Lane>(8 - reference.fy))),
        above(across()) {}

  hn::Vec<D> across() const {
    return hn::Add(hn::Mul(load(D(), row), rest_x), hn::Mul(load(D(), row + right), fx));
  }

  // I of the row; `step` leads to the next one, which has the weight fy.
  hn::Vec<D> next(size_t step) {
    row += step;
    hwy::Prefetch(reinterpret_cast<const int16_t*>(reinterpret_cast<uintptr_t>(row) + kAhead));
    const hn::Vec<D> here = across();
    const hn::Vec<D> sums = hn::Add(hn::Mul(above, rest_y), hn::Mul(here, fy));
    above = here;
    return sums;
  }

  const int16_t* row;
  size_t stride;
  size_t right;  // to the samples of weight fx
  size_t below;  // to the samples of weight fy
  hn::Vec<D> fx, rest_x, fy, rest_y;
  hn::Vec<D> above;
};

// The lanes of D from column x on.
template <unsigned kReferences, class D>
void put_columns(D lanes, const std::array<DisplacedReference, 2>& references,
                 const PredictionTarget& target, unsigned x) {
  Taps<D> first(references[0], x);
  Taps<D> second(references[kReferences - 1], x);
  const hn::Vec<D> half = hn::Set(lanes, 32 * kReferences);
  int16_t* out = target.data + x;
  const auto put = [&](size_t first_step, size_t second_step) {
    hn::Vec<D> sums = first.next(first_step);
    if constexpr (kReferences == 2) sums = hn::Add(sums, second.next(second_step));
    store(lanes, hn::ShiftRight<5 + kReferences>(hn::Add(sums, half)), out);
    out += target.stride;
  };
  for (unsigned y = 1; y < target.rows; ++y) put(first.stride, second.stride);
  put(first.below, second.below);
}

// Columns [x, columns): kLanes at a time, and what is left half as many at a time. Sum holds all
// sums.
template <class Sum, unsigned kReferences, unsigned kLanes = HWY_LANES(Sum)>
void interpolate(const std::array<DisplacedReference, 2>& references,
                 const PredictionTarget& target, unsigned x = 0) {
  for (; x + kLanes <= target.columns; x += kLanes) {
    put_columns<kReferences>(hn::FixedTag<Sum, kLanes>(), references, target, x);
  }
  if constexpr (kLanes > 1) {
    if (x < target.columns) interpolate<Sum, kReferences, kLanes / 2>(references, target, x);
  }
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
    narrow ? interpolate<int16_t, 1>(references, target)
           : interpolate<int32_t, 1>(references, target);
  } else {
    narrow ? interpolate<int16_t, 2>(references, target)
           : interpolate<int32_t, 2>(references, target);
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
