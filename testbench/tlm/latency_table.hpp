// Made by testbench clocks --header from what the unit takes: build the target rtl_latencies.
#pragma once

#include <array>
#include <cstdint>

namespace hmlfc::tb {

/// Clocks of a LOAD.
inline constexpr uint64_t kLoadClocks = 846;
/// Clocks of a request without its level blocks.
inline constexpr uint64_t kRequestClocks = 65;
/// Clocks of a level block: zero, motion only, motion and residual, residual only, key image.
inline constexpr std::array<uint64_t, 5> kLevelBlockClocks{1, 2, 2, 2, 1};

}  // namespace hmlfc::tb
