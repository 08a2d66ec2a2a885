// The size that a JPEG 2000 codestream declares, read before a decoder allocates for it.
#pragma once

#include <cstdint>
#include <span>

namespace hmlfc {

/// Whether `codestream` begins with the markers SOC and SIZ, and SIZ declares one component and one
/// tile of exactly `width` x `height` samples at the origin (KEY-2; ISO/IEC 15444-1, A.5.1).
bool declares_one_tile(std::span<const uint8_t> codestream, uint32_t width, uint32_t height);

}  // namespace hmlfc
