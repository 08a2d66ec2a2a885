// What this project uses of Highway, for builds without it: one instruction set, where code of one
// lane is preferred, and vectors of the compiler for the code that has no other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>

#define HWY_SCALAR 1
#define HWY_TARGET HWY_SCALAR
#define HWY_ONCE 1
#define HWY_NAMESPACE one_lane
#define HWY_BEFORE_NAMESPACE() static_assert(true)
#define HWY_AFTER_NAMESPACE() static_assert(true)
#define HWY_EXPORT(function) static_assert(true)
#define HWY_DYNAMIC_DISPATCH(function) one_lane::function

#define HWY_INLINE inline
#define HWY_RESTRICT __restrict__
#define HWY_LANES(type) (16 / sizeof(type))

namespace hwy::one_lane {

template <class T, size_t kCount>
struct FixedTag {
  static constexpr size_t kLanes = kCount;
  using Lane = T;
  typedef T Vector __attribute__((vector_size(kCount * sizeof(T))));
};
template <class D>
using TFromD = typename D::Lane;
template <class D>
using Vec = typename D::Vector;
template <class T, class D>
using Rebind = FixedTag<T, D::kLanes>;
template <class T, class D>
using Repartition = FixedTag<T, D::kLanes * sizeof(TFromD<D>) / sizeof(T)>;

template <class D>
inline Vec<D> Set(D, TFromD<D> value) {
  return Vec<D>{} + value;
}
template <class D>
inline Vec<D> LoadU(D, const TFromD<D>* from) {
  Vec<D> vector;
  std::memcpy(&vector, from, sizeof(vector));
  return vector;
}
template <class D>
inline void StoreU(Vec<D> vector, D, TFromD<D>* to) {
  std::memcpy(to, &vector, sizeof(vector));
}
template <class V>
inline V Add(V a, V b) {
  return a + b;
}
template <class V>
inline V Sub(V a, V b) {
  return a - b;
}
template <class V>
inline V Mul(V a, V b) {
  return a * b;
}
template <int kBits, class V>
inline V ShiftRight(V vector) {
  return vector >> kBits;
}
template <class D, class V>
inline Vec<D> PromoteTo(D, V vector) {
  return __builtin_convertvector(vector, Vec<D>);
}
template <class D, class V>
inline Vec<D> DemoteTo(D, V vector) {  // of values that fit
  return __builtin_convertvector(vector, Vec<D>);
}
template <class D, class V>
inline Vec<D> TruncateTo(D, V vector) {
  return __builtin_convertvector(vector, Vec<D>);
}
template <class D, class V>
inline Vec<D> BitCast(D, V vector) {
  return __builtin_bit_cast(Vec<D>, vector);
}
template <class D, class V>
inline Vec<D> ReorderWidenMulAccumulate(D lanes, V a, V b, Vec<D> sum, Vec<D>& other_sum) {
  const Vec<D> a2 = BitCast(lanes, a);
  const Vec<D> b2 = BitCast(lanes, b);
  other_sum += (a2 >> 16) * (b2 >> 16);
  return sum + (a2 << 16 >> 16) * (b2 << 16 >> 16);
}
template <class V>
inline V RearrangeToOddPlusEven(V sum, V other_sum) {
  return sum + other_sum;
}

}  // namespace hwy::one_lane
