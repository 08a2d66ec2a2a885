// CRC-32C (FIL-5).
#pragma once

#include <cstdint>
#include <span>

namespace hmlfc {

/// CRC-32C of `bytes`, continued from `crc`, the value for the bytes before them (0 for none).
///
/// Example: the nine bytes of "123456789" give 0xE3069283.
uint32_t crc32c(std::span<const uint8_t> bytes, uint32_t crc = 0);

}  // namespace hmlfc
