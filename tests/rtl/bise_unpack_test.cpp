// hmlfc_bise_unpack against bise_value (BISE-1 to BISE-10).
#include <span>
#include <vector>

#include <BiseUnpack16x10.h>
#include <BiseUnpack16x14.h>
#include <BiseUnpack4x10.h>
#include <BiseUnpack64x10.h>

#include "arithmetic/bise.hpp"
#include "rtl/ports.hpp"

namespace hmlfc::test {
namespace {

// Puts code T or Q of every group into `window`: `code`, another one in each group.
template <class Port>
void put_codes(Port& window, const Levels& levels, size_t count, unsigned code) {
  const auto layout = levels.digit == Digit::kTrit ? std::span<const DigitBits>(kTritLayout)
                                                   : std::span<const DigitBits>(kQuintLayout);
  size_t at = 0;
  for (size_t i = 0; i < count; ++i) {
    const unsigned group_code = code + 37 * static_cast<unsigned>(i / layout.size());
    const DigitBits& digit = layout[i % layout.size()];
    at += levels.plain_bits;
    put_bits(window, at, digit.count, group_code >> digit.first);
    at += digit.count;
  }
}

// Every level code; with digits, every T or Q in every group; random plain bits, and random bits
// after the end.
template <class Dut, unsigned kCount, unsigned kValueBits>
Counts unpack_all() {
  constexpr size_t kWindowBits = kCount * kValueBits;
  Dut dut;
  Random random(kCount + kValueBits);
  Counts counts;
  Pipeline<Dut, std::vector<uint32_t>> pipeline(dut, 3, random);
  for (unsigned code = 0; code <= 3 * kValueBits - 3; ++code) {
    const Levels levels = levels_of_code(code);
    for (unsigned turn = 0; turn < 256; ++turn) {
      dut.level_code = static_cast<uint8_t>(code);
      random.fill(dut.window, kWindowBits);
      if (levels.digit != Digit::kNone) put_codes(dut.window, levels, kCount, turn);
      std::vector<uint8_t> bytes;
      for (size_t at = 0; at < kWindowBits; at += 8) {
        bytes.push_back(static_cast<uint8_t>(get_bits(dut.window, at, 8)));
      }
      std::vector<uint32_t> expected;
      for (unsigned i = 0; i < kCount; ++i) {
        expected.push_back(bise_value(BitString(bytes), 0, levels, kCount, i));
      }
      pipeline.step(std::move(expected), [&](const std::vector<uint32_t>& values) {
        for (unsigned i = 0; i < kCount; ++i) {
          counts.compare(get_bits(dut.values, kValueBits * i, kValueBits), values[i]);
        }
      });
    }
  }
  return counts;
}

TEST(BiseUnpack, FourValues) { expect_equal((unpack_all<BiseUnpack4x10, 4, 10>()), 28 * 256 * 4); }
TEST(BiseUnpack, SixteenValues) {
  expect_equal((unpack_all<BiseUnpack16x10, 16, 10>()), 28 * 256 * 16);
}
TEST(BiseUnpack, SixtyFourValues) {
  expect_equal((unpack_all<BiseUnpack64x10, 64, 10>()), 28 * 256 * 64);
}
TEST(BiseUnpack, SixteenValuesOfDepth12) {
  expect_equal((unpack_all<BiseUnpack16x14, 16, 14>()), 40 * 256 * 16);
}

}  // namespace
}  // namespace hmlfc::test
