// Made by rtl_clocks --header from what the unit takes: build the target rtl_latencies.
#pragma once

#include <array>
#include <cstdint>

namespace hmlfc::tb {

/// Of a LOAD.
inline constexpr uint64_t kLoadClocks = 846;
/// Of a request, besides its level blocks.
inline constexpr uint64_t kRequestClocks = 65;
/// Of a level block: zero, motion only, motion and residual, residual only, key image.
inline constexpr std::array<uint64_t, 5> kLevelBlockClocks{1, 2, 2, 2, 1};

}  // namespace hmlfc::tb
