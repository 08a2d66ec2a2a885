// hmlfc_bise_place, hmlfc_bise_bits and hmlfc_bise_element against the model (BISE-3 to BISE-11).
#include <array>

#include <BiseBits.h>
#include <BiseElement10.h>
#include <BisePlace.h>

#include "arithmetic/bise.hpp"
#include "rtl/ports.hpp"

namespace hmlfc::test {
namespace {

// The groups before value m are whole: their length is that of a sequence of their values.
TEST(BisePlace, EveryIndexOfEveryCode) {
  BisePlace dut;
  Counts counts;
  for (unsigned code = 0; code <= kMaxLevelCode; ++code) {
    const Levels levels = levels_of_code(code);
    const auto size = static_cast<unsigned>(digit_group_size(levels));
    for (unsigned m = 0; m < 1024; ++m) {
      dut.level_code = static_cast<uint8_t>(code);
      dut.index = static_cast<uint16_t>(m);
      dut.eval();
      counts.compare(dut.slot, m % size);
      counts.compare(dut.group_bit, static_cast<int64_t>(bise_bits(levels, m / size * size)));
    }
  }
  expect_equal(counts, 40 * 1024 * 2);
}

TEST(BiseBits, EveryCountOfEveryCode) {
  BiseBits dut;
  Counts counts;
  for (unsigned code = 0; code <= kMaxLevelCode; ++code) {
    for (unsigned k = 0; k <= 1024; ++k) {
      dut.level_code = static_cast<uint8_t>(code);
      dut.count = static_cast<uint16_t>(k);
      tick(dut);
      tick(dut);
      counts.compare(dut.bits, static_cast<int64_t>(bise_bits(levels_of_code(code), k)));
    }
  }
  expect_equal(counts, 40 * 1025);
}

// The code of the group that begins at bit 0 becomes `code`.
template <size_t kMembers>
void put_code(uint64_t& window, unsigned plain_bits, const std::array<DigitBits, kMembers>& layout,
              unsigned code) {
  for (size_t j = 0; j < kMembers; ++j) {
    put_bits(window, plain_bits * (j + 1) + layout[j].first, layout[j].count,
             code >> layout[j].first);
  }
}

// Every code of T and Q at every slot of groups of every length, at every level code.
TEST(BiseElement, EverySlotOfEveryCode) {
  BiseElement10 dut;
  Random random(1);
  Counts counts;
  for (unsigned code = 0; code <= 27; ++code) {
    const Levels levels = levels_of_code(code);
    const auto size = static_cast<unsigned>(digit_group_size(levels));
    for (unsigned turn = 0; turn < 256; ++turn) {
      // A sequence whose last group has `present` values; one more group where it is whole.
      for (unsigned present = 1; present <= size + 1; ++present) {
        uint64_t window = 0;
        random.fill(window, 64);
        if (levels.digit == Digit::kTrit) put_code(window, levels.plain_bits, kTritLayout, turn);
        if (levels.digit == Digit::kQuint) put_code(window, levels.plain_bits, kQuintLayout, turn);
        const uint64_t length = bise_bits(levels, present);
        std::array<uint8_t, 16> bytes{};
        for (size_t i = 0; i < 8; ++i) bytes[i] = static_cast<uint8_t>(window >> (8 * i));
        for (unsigned slot = 0; slot < std::min(present, size); ++slot) {
          dut.window = window;
          dut.bits_left = static_cast<uint8_t>(std::min<uint64_t>(length, 64));
          dut.level_code = static_cast<uint8_t>(code);
          dut.slot = static_cast<uint8_t>(slot);
          dut.eval();
          counts.compare(dut.value, bise_value(BitString(bytes), 0, levels, present, slot));
        }
      }
    }
  }
  expect_equal(counts, 28 * 256 * 2);
}

}  // namespace
}  // namespace hmlfc::test
