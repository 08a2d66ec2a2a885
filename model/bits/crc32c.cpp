#include "bits/crc32c.hpp"

#include <array>

#include "bits/little_endian.hpp"

namespace hmlfc {
namespace {

// The polynomial 1EDC6F41 with its bits reversed, since the CRC is reflected.
constexpr uint32_t kReflectedPolynomial = 0x82F63B78u;

using Tables = std::array<std::array<uint32_t, 256>, 8>;

// Table k holds the effect of a byte that k more bytes follow: with eight tables, eight bytes are
// folded at once.
constexpr Tables make_tables() {
  Tables tables{};
  for (uint32_t byte = 0; byte < 256; ++byte) {
    uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc >> 1) ^ ((crc & 1u) != 0 ? kReflectedPolynomial : 0u);
    }
    tables[0][byte] = crc;
  }
  for (size_t k = 1; k < tables.size(); ++k) {
    for (size_t byte = 0; byte < 256; ++byte) {
      const uint32_t before = tables[k - 1][byte];
      tables[k][byte] = (before >> 8) ^ tables[0][before & 0xFFu];
    }
  }
  return tables;
}

constexpr Tables kTables = make_tables();

uint32_t fold_eight(std::span<const uint8_t> bytes, size_t at, uint32_t crc) {
  const uint64_t word = load_le<uint64_t>(bytes, at) ^ crc;
  uint32_t folded = 0;
  for (size_t k = 0; k < 8; ++k) folded ^= kTables[7 - k][(word >> (8 * k)) & 0xFFu];
  return folded;
}

}  // namespace

uint32_t crc32c(std::span<const uint8_t> bytes, uint32_t crc) {
  crc = ~crc;
  size_t at = 0;
  for (; bytes.size() - at >= 8; at += 8) crc = fold_eight(bytes, at, crc);
  for (; at < bytes.size(); ++at) crc = (crc >> 8) ^ kTables[0][(crc ^ bytes[at]) & 0xFFu];
  return ~crc;
}

}  // namespace hmlfc
