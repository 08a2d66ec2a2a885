// Dram: clocks at which lines come, by rows, banks and the bus.
#include "unit/dram.hpp"

#include <gtest/gtest.h>

namespace hmlfc::test {
namespace {

using tb::Dram;

constexpr uint64_t kSameBank = Dram::kRowBytes * Dram::kBanks;
constexpr uint64_t kClosed = Dram::kLatency + Dram::kOpenRow;  // the first line of a row

TEST(Dram, AnOpenRowIsQuicker) {
  Dram dram(64);
  EXPECT_EQ(dram.read_line(0, 100), 100 + kClosed);
  EXPECT_EQ(dram.read_line(Dram::kRowBytes - 1, 200), 200 + Dram::kLatency);
  EXPECT_EQ(dram.read_line(kSameBank, 300), 300 + kClosed);
  EXPECT_EQ(dram.read_line(0, 400), 400 + kClosed);
  EXPECT_EQ(dram.rows_opened(), 3u);
  EXPECT_EQ(dram.lines(), 4u);
}

TEST(Dram, BanksKeepTheirRows) {
  Dram dram(64);
  for (uint64_t bank = 0; bank < Dram::kBanks; ++bank) {
    EXPECT_EQ(dram.read_line(bank * Dram::kRowBytes, 100 * bank), 100 * bank + kClosed);
  }
  for (uint64_t bank = 0; bank < Dram::kBanks; ++bank) {
    const uint64_t now = 1000 + 100 * bank;
    EXPECT_EQ(dram.read_line(bank * Dram::kRowBytes + 64, now), now + Dram::kLatency);
  }
}

TEST(Dram, LinesTakeTheBusInTheOrderOfTheirRequests) {
  Dram dram(16);
  EXPECT_EQ(dram.read_line(0, 0), kClosed);
  EXPECT_EQ(dram.read_line(32, 0), kClosed + 4);  // the same line is read again
  EXPECT_EQ(dram.read_line(Dram::kRowBytes, 2), kClosed + 8);
  EXPECT_EQ(dram.busy_clocks(), 12u);
}

TEST(Dram, ABankTakesOneAddressAClock) {
  Dram dram(64);
  EXPECT_EQ(dram.read_line(0, 0), kClosed);
  EXPECT_EQ(dram.read_line(kSameBank, 0), kClosed + Dram::kOpenRow + 1);
}

}  // namespace
}  // namespace hmlfc::test
