// hmlfc_reference_window: coordinates clamped to the plane (MOT-10), as blocks and places in them.
#include <algorithm>
#include <cstdint>

#include <ReferenceWindow.h>

#include "rtl/ports.hpp"

namespace hmlfc::test {
namespace {

constexpr int kBlockLog2 = 2;
constexpr int kBlock = 1 << kBlockLog2;
constexpr int kSide = kBlock + 1;

// The sample that position `i` of the window stands for, from what the unit says.
int32_t sample(uint32_t first_block, const uint16_t& select, int i) {
  const uint32_t field = (static_cast<uint32_t>(select) >> (i * (kBlockLog2 + 1))) & 7;
  return static_cast<int32_t>((first_block + (field >> kBlockLog2)) << kBlockLog2 | (field & 3));
}

TEST(ReferenceWindow, ClampsEveryCoordinate) {
  ReferenceWindow dut;
  Random random(6);
  Counts counts;
  dut.advance = 1;
  for (int turn = 0; turn < 20'000; ++turn) {
    const int32_t width = random.often_extreme(1, 16384);
    const int32_t height = random.one_in(2) ? random.in(1, 9) : random.in(1, 16384);
    const int32_t x = random.one_in(2) ? width - random.in(-3, 8) : random.in(-1100, 17400);
    const int32_t y = random.one_in(2) ? random.in(-8, 3) : random.in(-1100, 17400);
    const bool extra_x = random.one_in(2);
    const bool extra_y = random.one_in(2);
    dut.x = static_cast<uint32_t>(x) & 0x1FFFF;
    dut.y = static_cast<uint32_t>(y) & 0x1FFFF;
    dut.width = static_cast<uint16_t>(width);
    dut.height = static_cast<uint16_t>(height);
    dut.extra_x = extra_x;
    dut.extra_y = extra_y;
    tick(dut);
    tick(dut);
    for (int i = 0; i < kSide; ++i) {
      const int32_t at_x = i == kBlock && !extra_x ? i - 1 : i;  // its weight is 0
      const int32_t at_y = i == kBlock && !extra_y ? i - 1 : i;
      counts.compare(sample(dut.block_x, dut.select_x, i), std::clamp(x + at_x, 0, width - 1));
      counts.compare(sample(dut.block_y, dut.select_y, i), std::clamp(y + at_y, 0, height - 1));
    }
    const int32_t last = std::clamp(x + kBlock - (extra_x ? 0 : 1), 0, width - 1);
    counts.compare(dut.two_x, last >> kBlockLog2 != std::clamp(x, 0, width - 1) >> kBlockLog2);
  }
  expect_equal(counts, 220'000);
}

}  // namespace
}  // namespace hmlfc::test
