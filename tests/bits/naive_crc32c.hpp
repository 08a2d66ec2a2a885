// CRC-32C by its definition, bit by bit.
#pragma once

#include <cstdint>
#include <span>

namespace hmlfc::test {

/// The words of FIL-5: the remainder of a division by the polynomial 1EDC6F41, highest power first,
/// where "reflected" means that each byte enters with its least significant bit first and that the
/// result's bits are read in reverse.
inline uint32_t naive_crc32c(std::span<const uint8_t> bytes) {
  uint32_t remainder = 0xFFFFFFFFu;
  for (const uint8_t byte : bytes) {
    for (int bit = 0; bit < 8; ++bit) {
      const uint32_t in = (byte >> bit) & 1u;
      const uint32_t out = remainder >> 31;
      remainder = (remainder << 1) ^ (in != out ? 0x1EDC6F41u : 0u);
    }
  }
  uint32_t reversed = 0;
  for (int bit = 0; bit < 32; ++bit) reversed |= ((remainder >> bit) & 1u) << (31 - bit);
  return reversed ^ 0xFFFFFFFFu;
}

}  // namespace hmlfc::test
