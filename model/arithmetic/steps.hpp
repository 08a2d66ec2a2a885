// Steps of residuals (STP-2).
#pragma once

#include <cassert>
#include <cstdint>

namespace hmlfc {

/// Greatest step code (STP-1).
inline constexpr unsigned kMaxStepCode = 15;

/// The step of `code` in [0, kMaxStepCode]; in [1, 256] (STP-2).
///
/// Example: codes 0 to 6 give 1, 2, 3, 4, 6, 8, 12.
constexpr int32_t step_of_code(unsigned code) {
  assert(code <= kMaxStepCode);
  if (code == 0) return 1;
  return code % 2 == 1 ? 1 << ((code + 1) / 2) : 3 << ((code - 2) / 2);
}

}  // namespace hmlfc
