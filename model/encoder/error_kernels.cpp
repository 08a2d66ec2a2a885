// With vectors of the instruction set chosen at run time.
#include "encoder/error_kernels.hpp"

#include <algorithm>
#include <array>

#include "syntax/geometry.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encoder/error_kernels.cpp"
#include <hwy/foreach_target.h>  // before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hmlfc {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class D>
inline hn::Vec<D> difference(D words, const int16_t* target, const int16_t* predicted) {
  return hn::Sub(hn::LoadU(words, target), hn::LoadU(words, predicted));
}

// `sum` and the products of two neighbouring words each.
template <class D, class V>
inline hn::Vec<D> add_products(D lanes, hn::Vec<D> sum, V a, V b) {
  auto odd = hn::Set(lanes, 0);
  const auto even = hn::ReorderWidenMulAccumulate(lanes, a, b, hn::Set(lanes, 0), odd);
  return hn::Add(sum, hn::RearrangeToOddPlusEven(even, odd));
}

// Where vectors have one word, a column; else two.
template <unsigned kColumns>
using Lanes = hn::FixedTag<int32_t, kColumns == 1 ? 1 : kColumns / 2>;

// Writes the sums of four columns each; where vectors have one, adds that of column x.
template <unsigned kColumns, class V>
inline void put(V sums, unsigned x, uint32_t* out) {
  if constexpr (kColumns == 1) {
    int32_t column;
    hn::StoreU(sums, Lanes<1>(), &column);
    *out = (x % 4 == 0 ? 0 : *out) + static_cast<uint32_t>(column);
  } else {
    const hn::Repartition<uint64_t, Lanes<kColumns>> pairs;
    const auto both = hn::BitCast(pairs, sums);
    const hn::Rebind<uint32_t, decltype(pairs)> squares;
    hn::StoreU(hn::TruncateTo(squares, hn::Add(both, hn::ShiftRight<32>(both))), squares, out);
  }
}

// kColumns columns from column x on.
template <unsigned kColumns>
void one_prediction(const SquareRow& row, const int16_t* predicted, unsigned x, uint32_t* out) {
  const hn::FixedTag<int16_t, kColumns> words;
  const Lanes<kColumns> lanes;
  auto sum = hn::Set(lanes, 0);
  for (unsigned j = 0; j < row.rows; ++j) {
    const auto d = difference(words, row.target + j * row.target_stride + x,
                              predicted + j * row.predicted_stride + x);
    sum = add_products(lanes, sum, d, d);
  }
  put<kColumns>(sum, x, out + x / 4);
}

// Likewise, for each reference set the product of the errors of its two parts, or of its one with
// itself.
template <unsigned kColumns>
void all_products(const SquareRow& row, const int16_t* const* predicted, unsigned x, uint32_t* out,
                  size_t stride) {
  const hn::FixedTag<int16_t, kColumns> words;
  const Lanes<kColumns> lanes;
  hn::Vec<Lanes<kColumns>> sums[kReferenceSets];
  for (auto& sum : sums) sum = hn::Set(lanes, 0);
  for (unsigned j = 0; j < row.rows; ++j) {
    const int16_t* target = row.target + j * row.target_stride + x;
    hn::Vec<decltype(words)> errors[4];
    for (size_t k = 0; k < 4; ++k) {
      errors[k] = difference(words, target, predicted[k] + j * row.predicted_stride + x);
    }
    for (unsigned set = 0; set < kReferenceSets; ++set) {
      const auto [a, b] = references_of_set(set).reference;
      sums[set] = add_products(lanes, sums[set], errors[a], errors[b]);
    }
  }
  for (unsigned set = 0; set < kReferenceSets; ++set) {
    put<kColumns>(sums[set], x, out + set * stride + x / 4);
  }
}

// Columns from x on: kColumns at a time, then half as many, down to four.
template <unsigned kColumns = HWY_LANES(int16_t)>
void whole_squares(const SquareRow& row, const int16_t* const* predicted, bool sets, uint32_t* out,
                   size_t stride, unsigned x = 0) {
  for (; x + kColumns <= row.columns; x += kColumns) {
    sets ? all_products<kColumns>(row, predicted, x, out, stride)
         : one_prediction<kColumns>(row, predicted[0], x, out);
  }
  if constexpr (kColumns > 4) whole_squares<kColumns / 2>(row, predicted, sets, out, stride, x);
}

// Makes squared errors of means of products: these follow from the errors of the two parts, with
// about what rounding adds.
void means(uint32_t* out, size_t stride, unsigned squares) {
  constexpr std::array<size_t, 4> kAlone{0, 3, 4, 7};  // the sets of K0 to K3
  for (unsigned set = 0; set < kReferenceSets; ++set) {
    const ReferenceSet refs = references_of_set(set);
    if (refs.count == 1) continue;
    const uint32_t* a = out + kAlone[refs.reference[0]] * stride;
    const uint32_t* b = out + kAlone[refs.reference[1]] * stride;
    uint32_t* both = out + set * stride;
    for (unsigned i = 0; i < squares; ++i) both[i] = (a[i] + b[i] + 2 * both[i] + 10) / 4;
  }
}

void errors_here(const SquareRow& row, const int16_t* const* predicted, bool sets, uint32_t* out,
                 size_t stride) {
  whole_squares(row, predicted, sets, out, stride);
  if (sets) means(out, stride, row.columns / 4);
}

void spread_here(const SpreadRows& from, int32_t* out, size_t stride) {
  constexpr unsigned kLanes = HWY_LANES(int32_t) < kSpreadAhead ? HWY_LANES(int32_t) : kSpreadAhead;
  const hn::FixedTag<int32_t, kLanes> lanes;
  const auto left = hn::Set(lanes, from.fx);
  const auto here = hn::Set(lanes, 8 - from.fx);
  const auto above = hn::Set(lanes, from.fy);
  const auto level = hn::Set(lanes, 8 - from.fy);
  for (unsigned x = 0; x <= from.columns; x += kLanes) {
    const int32_t* in = from.values + x;
    int32_t* to = out + x;
    auto before = hn::Set(lanes, 0);
    for (unsigned j = 0; j < from.rows; ++j, in += from.stride, to += stride) {
      const auto now =
          hn::Add(hn::Mul(hn::LoadU(lanes, in), here), hn::Mul(hn::LoadU(lanes, in - 1), left));
      const auto sum = hn::Add(hn::Mul(now, level), hn::Mul(before, above));
      hn::StoreU(hn::Add(hn::LoadU(lanes, to), sum), lanes, to);
      before = now;
    }
    hn::StoreU(hn::Add(hn::LoadU(lanes, to), hn::Mul(before, above)), lanes, to);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace hmlfc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace hmlfc {

HWY_EXPORT(errors_here);
HWY_EXPORT(spread_here);

namespace {

void all_errors(const SquareRow& row, const int16_t* const* predicted, bool sets, uint32_t* out,
                size_t stride) {
  HWY_DYNAMIC_DISPATCH(errors_here)(row, predicted, sets, out, stride);
  const unsigned rest = row.columns % 4;
  if (rest == 0) return;
  // What is left of a square, next to differences of 0.
  const unsigned x = row.columns - rest;
  std::array<std::array<int16_t, 16>, 5> parts{};
  const int16_t* last[] = {parts[0].data(), parts[1].data(), parts[2].data(), parts[3].data()};
  for (unsigned j = 0; j < row.rows; ++j) {
    for (unsigned k = 0; k < (sets ? 4u : 1u); ++k) {
      std::copy_n(predicted[k] + j * row.predicted_stride + x, rest, &parts[k][4 * j]);
    }
    std::copy_n(row.target + j * row.target_stride + x, rest, &parts[4][4 * j]);
  }
  HWY_DYNAMIC_DISPATCH(errors_here)
  ({parts[4].data(), 4, 4, 4, row.rows}, last, sets, out + x / 4, stride);
}

}  // namespace

void square_errors(const SquareRow& row, const int16_t* predicted, uint32_t* out) {
  all_errors(row, &predicted, false, out, 0);
}

void set_errors(const SquareRow& row, const std::array<const int16_t*, 4>& predicted, uint32_t* out,
                size_t stride) {
  all_errors(row, predicted.data(), true, out, stride);
}

void spread(const SpreadRows& from, int32_t* out, size_t stride) {
  HWY_DYNAMIC_DISPATCH(spread_here)(from, out, stride);
}

}  // namespace hmlfc

#endif  // HWY_ONCE
