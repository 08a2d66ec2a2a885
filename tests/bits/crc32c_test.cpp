// crc32c against published values and against its definition (FIL-5).
#include "bits/crc32c.hpp"

#include <cstdint>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "bits/naive_crc32c.hpp"

namespace hmlfc {
namespace {

using test::naive_crc32c;

std::vector<uint8_t> bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

std::vector<uint8_t> counting(uint8_t first, int step) {
  std::vector<uint8_t> bytes;
  for (int i = 0; i < 32; ++i) bytes.push_back(static_cast<uint8_t>(first + step * i));
  return bytes;
}

// FIL-5, and the four 32-byte messages of RFC 3720, appendix B.4.
TEST(Crc32c, PublishedValues) {
  EXPECT_EQ(crc32c(bytes_of("123456789")), 0xE3069283u);
  EXPECT_EQ(crc32c(std::vector<uint8_t>(32, 0x00)), 0x8A9136AAu);
  EXPECT_EQ(crc32c(std::vector<uint8_t>(32, 0xFF)), 0x62A8AB43u);
  EXPECT_EQ(crc32c(counting(0, 1)), 0x46DD794Eu);
  EXPECT_EQ(crc32c(counting(31, -1)), 0x113FDB5Cu);
}

TEST(Crc32c, EveryLengthAndEveryByteValue) {
  std::vector<uint8_t> bytes(300);
  std::iota(bytes.begin(), bytes.end(), uint8_t{7});
  for (size_t length = 0; length <= bytes.size(); ++length) {
    const std::span<const uint8_t> part(bytes.data(), length);
    ASSERT_EQ(crc32c(part), naive_crc32c(part)) << length;
  }
}

TEST(Crc32c, ContinuesAtEverySplit) {
  std::vector<uint8_t> bytes(41);
  std::iota(bytes.begin(), bytes.end(), uint8_t{200});
  const std::span<const uint8_t> all(bytes);
  for (size_t split = 0; split <= bytes.size(); ++split) {
    EXPECT_EQ(crc32c(all.subspan(split), crc32c(all.first(split))), naive_crc32c(all)) << split;
  }
}

TEST(Crc32c, EverySingleBitMatters) {
  std::vector<uint8_t> bytes(37, 0x3C);
  const uint32_t intact = crc32c(bytes);
  for (size_t k = 0; k < bytes.size() * 8; ++k) {
    bytes[k / 8] ^= static_cast<uint8_t>(1u << (k % 8));
    EXPECT_NE(crc32c(bytes), intact) << k;
    EXPECT_EQ(crc32c(bytes), naive_crc32c(bytes)) << k;
    bytes[k / 8] ^= static_cast<uint8_t>(1u << (k % 8));
  }
}

}  // namespace
}  // namespace hmlfc
