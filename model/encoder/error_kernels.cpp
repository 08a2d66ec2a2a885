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
inline hn::Vec<D> difference(D lanes, const int16_t* target, const int16_t* predicted) {
  const hn::Rebind<int16_t, D> words;
  return hn::PromoteTo(lanes, hn::Sub(hn::LoadU(words, target), hn::LoadU(words, predicted)));
}

template <class V>
inline V add_product(V sum, V a, V b) {
  return hn::Add(sum, hn::Mul(a, b));
}

// Writes the sums of four lanes each; where vectors have one, adds that of column x.
template <unsigned kLanes, class V>
inline void put(V columns, unsigned x, uint32_t* out) {
  int32_t sums[kLanes];
  hn::StoreU(columns, hn::FixedTag<int32_t, kLanes>(), sums);
  if constexpr (kLanes == 1) {
    *out = (x % 4 == 0 ? 0 : *out) + static_cast<uint32_t>(sums[0]);
  } else {
    for (unsigned i = 0; i < kLanes; i += 4) {
      out[i / 4] = static_cast<uint32_t>(sums[i]) + static_cast<uint32_t>(sums[i + 1]) +
                   static_cast<uint32_t>(sums[i + 2]) + static_cast<uint32_t>(sums[i + 3]);
    }
  }
}

// kLanes columns from column x on.
template <unsigned kLanes>
void one_prediction(const SquareRow& row, const int16_t* predicted, unsigned x, uint32_t* out) {
  const hn::FixedTag<int32_t, kLanes> lanes;
  auto sum = hn::Set(lanes, 0);
  for (unsigned j = 0; j < row.rows; ++j) {
    const auto d = difference(lanes, row.target + j * row.target_stride + x,
                              predicted + j * row.predicted_stride + x);
    sum = add_product(sum, d, d);
  }
  put<kLanes>(sum, x, out + x / 4);
}

// Likewise. The squared error of a mean follows from products of the errors of its two parts.
template <unsigned kLanes>
void all_sets(const SquareRow& row, const int16_t* const* predicted, unsigned x, uint32_t* out,
              size_t stride) {
  const hn::FixedTag<int32_t, kLanes> lanes;
  const auto zero = hn::Set(lanes, 0);
  auto s0 = zero, s1 = zero, s2 = zero, s3 = zero, s01 = zero, s02 = zero, s12 = zero, s03 = zero;
  for (unsigned j = 0; j < row.rows; ++j) {
    const int16_t* target = row.target + j * row.target_stride + x;
    const size_t at = j * row.predicted_stride + x;
    const auto d0 = difference(lanes, target, predicted[0] + at);
    const auto d1 = difference(lanes, target, predicted[1] + at);
    const auto d2 = difference(lanes, target, predicted[2] + at);
    const auto d3 = difference(lanes, target, predicted[3] + at);
    s0 = add_product(s0, d0, d0);
    s1 = add_product(s1, d1, d1);
    s2 = add_product(s2, d2, d2);
    s3 = add_product(s3, d3, d3);
    s01 = add_product(s01, d0, d1);
    s02 = add_product(s02, d0, d2);
    s12 = add_product(s12, d1, d2);
    s03 = add_product(s03, d0, d3);
  }
  // With about what rounding a mean adds to its error.
  const auto mean = [&](auto a, auto b, auto product) {
    const auto squares = hn::Add(hn::Add(a, b), hn::Add(product, product));
    return hn::ShiftRight<2>(hn::Add(squares, hn::Set(lanes, 4)));
  };
  out += x / 4;
  put<kLanes>(s0, x, out);
  put<kLanes>(mean(s0, s1, s01), x, out + stride);
  put<kLanes>(mean(s0, s2, s02), x, out + 2 * stride);
  put<kLanes>(s1, x, out + 3 * stride);
  put<kLanes>(s2, x, out + 4 * stride);
  put<kLanes>(mean(s1, s2, s12), x, out + 5 * stride);
  put<kLanes>(mean(s0, s3, s03), x, out + 6 * stride);
  put<kLanes>(s3, x, out + 7 * stride);
}

// Columns from x on: kLanes at a time, then half as many, down to four.
template <unsigned kLanes = HWY_LANES(int32_t)>
void whole_squares(const SquareRow& row, const int16_t* const* predicted, bool sets, uint32_t* out,
                   size_t stride, unsigned x = 0) {
  for (; x + kLanes <= row.columns; x += kLanes) {
    sets ? all_sets<kLanes>(row, predicted, x, out, stride)
         : one_prediction<kLanes>(row, predicted[0], x, out);
  }
  if constexpr (kLanes > 4) whole_squares<kLanes / 2>(row, predicted, sets, out, stride, x);
}

void errors_here(const SquareRow& row, const int16_t* const* predicted, bool sets, uint32_t* out,
                 size_t stride) {
  whole_squares(row, predicted, sets, out, stride);
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
