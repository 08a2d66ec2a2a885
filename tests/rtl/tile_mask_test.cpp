// hmlfc_tile_mask: every mode, every size of tile, against TIL-2 and TIL-3 bit by bit.
#include <cstdint>

#include <TileMask.h>

#include "rtl/ports.hpp"
#include "syntax/tile_masks.hpp"

namespace hmlfc::test {
namespace {

struct Mask {
  uint64_t mask = 0;
  unsigned bits = 0;
};

// TIL-3, a bit at a time; bit(i) is bit i of the record from the mask on.
template <class Bit>
Mask read_mask(unsigned mode, uint64_t inside, const Bit& bit) {
  if (mode == 0) return {};
  if (mode == 1) return {inside, 0};
  Mask read;
  if (mode == 2) {
    for (unsigned k = 0; k < 64; ++k) read.mask |= uint64_t{bit(k)} << k;
    read.bits = 64;
    return read;
  }
  read.bits = 16;
  for (unsigned quad = 0; quad < 16; ++quad) {
    if (bit(quad) == 0) continue;
    for (unsigned k = 0; k < 4; ++k) read.mask |= uint64_t{bit(read.bits++)} << (4 * quad + k);
  }
  return read;
}

TEST(TileMask, EveryModeAndSize) {
  TileMask dut;
  Random random(5);
  Counts counts;
  for (uint32_t turn = 0; turn < 40'000; ++turn) {
    const auto columns = static_cast<uint32_t>(random.in(1, 8));
    const auto rows = static_cast<uint32_t>(random.in(1, 8));
    dut.columns = static_cast<uint8_t>(columns);
    dut.rows = static_cast<uint8_t>(rows);
    dut.mode = turn & 3;
    random.fill(dut.field, 80);
    if (random.one_in(4)) put_bits(dut.field, 0, 16, random.one_in(2) ? 0xFFFF : 0);
    dut.eval();
    uint64_t inside = 0;
    for (unsigned j = 0; j < rows; ++j) {
      for (unsigned i = 0; i < columns; ++i) inside |= uint64_t{1} << block_number(i, j);
    }
    const Mask expected =
        read_mask(dut.mode, inside, [&](size_t i) { return get_bits(dut.field, i, 1); });
    counts.compare(static_cast<int64_t>(dut.in_plane), static_cast<int64_t>(inside));
    counts.compare(static_cast<int64_t>(dut.mask), static_cast<int64_t>(expected.mask));
    counts.compare(dut.bits, expected.bits);
  }
  expect_equal(counts, 120'000);
}

}  // namespace
}  // namespace hmlfc::test
