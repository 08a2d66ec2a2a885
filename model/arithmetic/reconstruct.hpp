// The arithmetic of one sample (TIL-10, STP-2, STP-3, DEC-3).
#pragma once

#include <cassert>
#include <cstdint>

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"

namespace hmlfc {
/// Largest step code (STP-1).
inline constexpr unsigned kMaxStepCode = 15;

/// The step of `code` in [0, kMaxStepCode]; in [1, 256] (STP-2).
///
/// Example: codes 0 to 6 give 1, 2, 3, 4, 6, 8, 12.
constexpr int32_t step_of_code(unsigned code) {
  assert(code <= kMaxStepCode);
  if (code == 0) return 1;
  return code % 2 == 1 ? 1 << ((code + 1) / 2) : 3 << ((code - 2) / 2);
}

/// The residual of BISE value `value` in [0, levels - 1] with `bias` (TIL-10); in [-bound, bound].
///
/// Example: value 0 of 40 levels with bias 3 is -17.
constexpr int32_t residual_of_value(uint32_t value, uint32_t levels, int32_t bias,
                                    const SampleRange& range) {
  const int32_t centred = static_cast<int32_t>(value) - static_cast<int32_t>(levels >> 1);
  const int32_t unclamped = centred + bias;
  watch("BISE value", value, range);
  watch("bias", bias, range);
  watch("residual before its clamp", unclamped, range);
  return clamp(unclamped, -range.bound, range.bound);
}

/// The residual of a block whose values are multiples of `step` in [1, 256] (STP-3); in
/// [-bound, bound]. Step 1 gives residual_of_value.
///
/// Example: value 0 of 40 levels with bias 3 and step 4 is -68.
constexpr int32_t stepped_residual(uint32_t value, uint32_t levels, int32_t bias, int32_t step,
                                   const SampleRange& range) {
  const int32_t stepped = step * residual_of_value(value, levels, bias, range);
  const int32_t residual = clamp(stepped, -range.bound, range.bound);
  watch("residual bound M", range.bound, range);
  watch("step * residual", stepped, range);
  watch("residual, SRV reference", residual, range);
  return residual;
}

/// A(x, y) of DEC-3 with motion: `parent` in [lo, hi] or 0, `reference` in [-bound, bound].
constexpr int32_t motion_prediction(int32_t parent, bool negative, int32_t reference,
                                    const SampleRange& range) {
  const int32_t phased = negative ? parent - reference : parent + reference;
  watch("sample, parent P", parent, range);
  watch("P + sign * ref", phased, range);
  return clamp(phased, range.lo, range.hi);
}

/// The sample of DEC-3: `prediction` in [lo, hi], `residual` in [-bound, bound].
constexpr int32_t add_residual(int32_t prediction, int32_t residual, const SampleRange& range) {
  const int32_t corrected = prediction + residual;
  watch("A + residual", corrected, range);
  return clamp(corrected, range.lo, range.hi);
}

}  // namespace hmlfc
