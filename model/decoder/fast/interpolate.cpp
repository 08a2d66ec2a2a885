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

// One reference from column x on.
struct Taps {
  Taps(const DisplacedReference& reference, unsigned x)
      : row(reference.view.data + x),
        stride(reference.view.stride),
        right(reference.fx == 0 ? 0 : 1),
        below(reference.fy == 0 ? 0 : reference.view.stride),
        fx(static_cast<int16_t>(reference.fx)),
        fy(static_cast<int16_t>(reference.fy)) {}

  const int16_t* row;
  size_t stride;
  size_t right;  // to the samples of weight fx
  size_t below;  // to the samples of weight fy
  int16_t fx, fy;
};

// 8 times the row blended across. The weights of MOT-9 are products, so one serves two rows of
// sums.
template <class D>
inline hn::Vec<D> across(D lanes, const Taps& taps) {
  using Lane = hn::TFromD<D>;
  hwy::Prefetch(reinterpret_cast<const int16_t*>(reinterpret_cast<uintptr_t>(taps.row) + kAhead));
  return hn::Add(
      hn::Mul(load(lanes, taps.row), hn::Set(lanes, static_cast<Lane>(8 - taps.fx))),
      hn::Mul(load(lanes, taps.row + taps.right), hn::Set(lanes, static_cast<Lane>(taps.fx))));
}

// I of MOT-9.
template <class D>
inline hn::Vec<D> down(D lanes, const Taps& taps, hn::Vec<D> above, hn::Vec<D> here) {
  using Lane = hn::TFromD<D>;
  return hn::Add(hn::Mul(above, hn::Set(lanes, static_cast<Lane>(8 - taps.fy))),
                 hn::Mul(here, hn::Set(lanes, static_cast<Lane>(taps.fy))));
}

// The lanes of D from column x on.
template <unsigned kReferences, class D>
HWY_INLINE void put_columns(D lanes, const std::array<DisplacedReference, 2>& references,
                            const PredictionTarget& target, unsigned x) {
  Taps first(references[0], x);
  Taps second(references[kReferences - 1], x);
  const hn::Vec<D> half = hn::Set(lanes, 32 * kReferences);
  hn::Vec<D> above = across(lanes, first);
  hn::Vec<D> second_above = across(lanes, second);
  int16_t* out = target.data + x;
  for (unsigned y = 1; y <= target.rows; ++y, out += target.stride) {
    first.row += y < target.rows ? first.stride : first.below;
    const hn::Vec<D> here = across(lanes, first);
    hn::Vec<D> sums = hn::Add(down(lanes, first, above, here), half);
    above = here;
    if constexpr (kReferences == 2) {
      second.row += y < target.rows ? second.stride : second.below;
      const hn::Vec<D> second_here = across(lanes, second);
      sums = hn::Add(sums, down(lanes, second, second_above, second_here));
      second_above = second_here;
    }
    store(lanes, hn::ShiftRight<5 + kReferences>(sums), out);
  }
}

// Wider vectors gain nothing: most pieces are 4, 8 or 16 samples wide.
template <class Sum>
constexpr unsigned kMostLanes = HWY_LANES(Sum) < 16 ? HWY_LANES(Sum) : 16;

// Columns [x, columns): kLanes at a time, and what is left half as many at a time. Sum holds all
// sums.
template <class Sum, unsigned kReferences, unsigned kLanes = kMostLanes<Sum>>
HWY_INLINE void interpolate(const std::array<DisplacedReference, 2>& references,
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
