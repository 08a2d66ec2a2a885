// What this project uses of Highway, for builds without it: one instruction set, of one lane, and
// no vectors.
#pragma once

#include <algorithm>

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
