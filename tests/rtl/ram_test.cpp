// hmlfc_ram against an array: words that were written, a word that is held, and what a read gives
// of a word written in its clock.
#include <array>
#include <cstdint>

#include <Ram.h>

#include "rtl/ports.hpp"

namespace hmlfc::test {
namespace {

TEST(Ram, WordsHoldsAndCollisions) {
  constexpr int kWords = 8;
  Ram dut;
  Random random(21);
  Counts counts;
  std::array<uint8_t, kWords> words{};
  dut.write = 1;
  for (uint8_t i = 0; i < kWords; ++i) {
    dut.write_address = i;
    dut.write_data = words[i] = static_cast<uint8_t>(random.in(0, 255));
    tick(dut);
  }
  dut.read = 1;
  uint8_t expected = 0;
  int collisions = 0;
  for (int clock = 0; clock < 20'000; ++clock) {
    dut.write = random.one_in(2) ? 1 : 0;
    dut.write_address = static_cast<uint8_t>(random.in(0, kWords - 1));
    dut.write_data = static_cast<uint8_t>(random.in(0, 255));
    dut.read_address = static_cast<uint8_t>(random.in(0, kWords - 1));
    const bool collides = dut.read && dut.write && dut.read_address == dut.write_address;
    const uint8_t word = words[dut.read_address];
    if (dut.read) expected = collides ? static_cast<uint8_t>(~word) : word;
    collisions += collides ? 1 : 0;
    if (dut.write) words[dut.write_address] = dut.write_data;
    tick(dut);
    counts.compare(dut.read_data, expected);
    dut.read = random.one_in(2) ? 1 : 0;
  }
  expect_equal(counts, 20'000);
  EXPECT_GE(collisions, 500);
}

}  // namespace
}  // namespace hmlfc::test
