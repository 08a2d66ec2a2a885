// With vectors of the instruction set chosen at run time.
#include "encoder/error_kernels.hpp"

#include <algorithm>

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
  auto odd = hn::Zero(lanes);
  const auto even = hn::ReorderWidenMulAccumulate(lanes, a, b, hn::Zero(lanes), odd);
  return hn::Add(sum, hn::RearrangeToOddPlusEven(even, odd));
}

// Where vectors have one word, a column; else two.
template <unsigned kColumns>
using Lanes = hn::FixedTag<int32_t, kColumns == 1 ? 1 : kColumns / 2>;

// Writes the sums of four columns each; where vectors have one, adds that of column x.
template <unsigned kColumns, class V>
inline void put(V sums, unsigned x, uint32_t* out) {
  if constexpr (kColumns == 1) {
    *out = (x % 4 == 0 ? 0 : *out) + static_cast<uint32_t>(hn::GetLane(sums));
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
  auto sum = hn::Zero(lanes);
  for (unsigned j = 0; j < row.rows; ++j) {
    const auto d = difference(words, row.target + j * row.target_stride + x,
                              predicted + j * row.predicted_stride + x);
    sum = add_products(lanes, sum, d, d);
  }
  put<kColumns>(sum, x, out + x / 4);
}

// Likewise, squares and products of the errors of K0 to K3, by reference set (MOT-7).
template <unsigned kColumns>
void all_products(const SquareRow& row, const int16_t* const* predicted, unsigned x, uint32_t* out,
                  size_t stride) {
  const hn::FixedTag<int16_t, kColumns> words;
  const Lanes<kColumns> lanes;
  const auto zero = hn::Zero(lanes);
  auto s0 = zero, s1 = zero, s2 = zero, s3 = zero, s01 = zero, s02 = zero, s12 = zero, s03 = zero;
  for (unsigned j = 0; j < row.rows; ++j) {
    const int16_t* target = row.target + j * row.target_stride + x;
    const size_t at = j * row.predicted_stride + x;
    const auto d0 = difference(words, target, predicted[0] + at);
    const auto d1 = difference(words, target, predicted[1] + at);
    const auto d2 = difference(words, target, predicted[2] + at);
    const auto d3 = difference(words, target, predicted[3] + at);
    s0 = add_products(lanes, s0, d0, d0);
    s1 = add_products(lanes, s1, d1, d1);
    s2 = add_products(lanes, s2, d2, d2);
    s3 = add_products(lanes, s3, d3, d3);
    s01 = add_products(lanes, s01, d0, d1);
    s02 = add_products(lanes, s02, d0, d2);
    s12 = add_products(lanes, s12, d1, d2);
    s03 = add_products(lanes, s03, d0, d3);
  }
  out += x / 4;
  put<kColumns>(s0, x, out);
  put<kColumns>(s01, x, out + stride);
  put<kColumns>(s02, x, out + 2 * stride);
  put<kColumns>(s1, x, out + 3 * stride);
  put<kColumns>(s2, x, out + 4 * stride);
  put<kColumns>(s12, x, out + 5 * stride);
  put<kColumns>(s03, x, out + 6 * stride);
  put<kColumns>(s3, x, out + 7 * stride);
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
  const auto mean = [&](size_t set, size_t a, size_t b) {
    for (unsigned i = 0; i < squares; ++i) {
      uint32_t& product = out[set * stride + i];
      product = (out[a * stride + i] + out[b * stride + i] + 2 * product + 10) / 4;
    }
  };
  mean(1, 0, 3);
  mean(2, 0, 4);
  mean(5, 3, 4);
  mean(6, 0, 7);
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
