// hmlfc_registers: AXI4-Lite with all orders of its channels (docs/decode_unit.md); the whole
// unit's tests have the rest. The offsets and bits are said here a second time, so that a slip in
// rtl/registers.json is seen.
#include <algorithm>
#include <array>
#include <cstdint>

#include <Registers.h>

#include "driver/hmlfc_registers.h"
#include "rtl/ports.hpp"

namespace hmlfc::test {
namespace {

/// Drives the AXI4-Lite port; counts the pulses of CONTROL.
class Bench {
 public:
  Registers dut;
  int loads = 0, disables = 0;

  Bench() {
    dut.rst_n = 0;
    clock();
    clock();
    dut.rst_n = 1;
    loads = disables = 0;
  }

  void clock() {
    tick(dut);
    loads += dut.load;
    disables += dut.disable_unit;
  }

  /// `data_late` clocks between address and data, negative: the data come first.
  void write(uint32_t address, uint32_t data, uint32_t strobes = 0xF, int data_late = 0,
             int answer_late = 0) {
    dut.s_axil_awaddr = static_cast<uint16_t>(address);
    dut.s_axil_wdata = data;
    dut.s_axil_wstrb = static_cast<uint8_t>(strobes);
    const int address_clock = data_late < 0 ? -data_late : 0;
    const int data_clock = data_late > 0 ? data_late : 0;
    for (int at = 0; at <= std::max(address_clock, data_clock); ++at) {
      dut.s_axil_awvalid = at == address_clock;
      dut.s_axil_wvalid = at == data_clock;
      dut.eval();
      EXPECT_TRUE(dut.s_axil_awready || !dut.s_axil_awvalid);
      EXPECT_TRUE(dut.s_axil_wready || !dut.s_axil_wvalid);
      EXPECT_FALSE(dut.s_axil_bvalid) << "an answer before the write";
      clock();
    }
    dut.s_axil_awvalid = 0;
    dut.s_axil_wvalid = 0;
    clock();
    for (int at = 0; at < answer_late; ++at) {
      EXPECT_TRUE(dut.s_axil_bvalid);
      clock();
    }
    EXPECT_TRUE(dut.s_axil_bvalid);
    EXPECT_EQ(dut.s_axil_bresp, 0);
    dut.s_axil_bready = 1;
    clock();
    dut.s_axil_bready = 0;
    EXPECT_FALSE(dut.s_axil_bvalid);
  }

  uint32_t read(uint32_t address, int answer_late = 0) {
    dut.s_axil_araddr = static_cast<uint16_t>(address);
    dut.s_axil_arvalid = 1;
    dut.eval();
    EXPECT_TRUE(dut.s_axil_arready);
    clock();
    dut.s_axil_arvalid = 0;
    for (int at = 0; at < answer_late; ++at) clock();
    EXPECT_TRUE(dut.s_axil_rvalid);
    EXPECT_FALSE(dut.s_axil_arready) << "one read at a time";
    EXPECT_EQ(dut.s_axil_rresp, 0);
    const uint32_t data = dut.s_axil_rdata;
    dut.s_axil_rready = 1;
    clock();
    dut.s_axil_rready = 0;
    EXPECT_FALSE(dut.s_axil_rvalid);
    return data;
  }

  uint64_t read_pair(uint32_t address) {
    const uint64_t low = read(address);
    return low | uint64_t{read(address + 4)} << 32;
  }

  void give_error(unsigned error, uint64_t request) {
    dut.error_valid = 1;
    dut.error = static_cast<uint8_t>(error);
    dut.error_request = request;
    clock();
    dut.error_valid = 0;
  }
};

TEST(Registers, IdentityAndParameters) {
  Bench bench;
  EXPECT_EQ(bench.read(0x00), 0x464C4D48u) << "bytes 48 4D 4C 46";
  EXPECT_EQ(bench.read(0x04), 0x00001082u);
  EXPECT_EQ(bench.read(HMLFC_REG_PARAMETERS), HMLFC_REG_PARAMETERS_RESET);
}

TEST(Registers, Status) {
  Bench bench;
  for (unsigned bits = 0; bits < 8; ++bits) {
    bench.dut.ready = bits & 1;
    bench.dut.loading = (bits >> 1) & 1;
    bench.dut.idle = (bits & 4) != 0;
    bench.dut.load_error = static_cast<uint8_t>(8 * bits + 5);
    EXPECT_EQ(bench.read(0x0C), bits | (8 * bits + 5) << 8);
  }
}

TEST(Registers, SettingsAreKeptByteByByte) {
  Bench bench;
  Random random(11);
  std::array<uint32_t, 7> words{};
  for (int turn = 0; turn < 2000; ++turn) {
    const auto k = static_cast<size_t>(random.in(0, 6));
    const auto strobes = static_cast<uint32_t>(random.in(0, 15));
    const auto data = static_cast<uint32_t>(random.in(INT32_MIN, INT32_MAX));
    for (unsigned byte = 0; byte < 4; ++byte) {
      const uint32_t mask = 0xFFu << (8 * byte);
      if ((strobes >> byte) & 1) words[k] = (words[k] & ~mask) | (data & mask);
    }
    if (k == 1 || k == 5) words[k] &= 0xFF;  // addresses have 40 bits
    bench.write(0x10 + 4 * static_cast<uint32_t>(k), data, strobes, random.in(-3, 3),
                random.in(0, 2));
    for (uint32_t i = 0; i < 6; ++i) {
      ASSERT_EQ(bench.read(0x10 + 4 * i, random.in(0, 2)), words[i]) << i << " at " << turn;
    }
    ASSERT_EQ(bench.read(0x28), 0u);
    ASSERT_EQ(bench.dut.stream_base, words[0] | uint64_t{words[1]} << 32);
    ASSERT_EQ(bench.dut.stream_bytes, words[2] | uint64_t{words[3]} << 32);
    ASSERT_EQ(bench.dut.reference_base, words[4] | uint64_t{words[5]} << 32);
  }
  EXPECT_EQ(bench.loads + bench.disables, 0);
}

// A second write that is taken before the answer to the first waits for it: two writes, two
// answers.
TEST(Registers, OneAnswerForEachWrite) {
  Bench bench;
  Registers& dut = bench.dut;
  int taken = 0, answers = 0;
  for (int at = 0; at < 20; ++at) {
    dut.s_axil_awaddr = 0x10;
    dut.s_axil_wdata = static_cast<uint32_t>(taken + 1);
    dut.s_axil_wstrb = 0xF;
    dut.s_axil_awvalid = dut.s_axil_wvalid = taken < 2;
    dut.s_axil_bready = at >= 10;
    dut.eval();
    if (dut.s_axil_awvalid && dut.s_axil_awready) ++taken;
    if (dut.s_axil_bvalid && dut.s_axil_bready) ++answers;
    bench.clock();
    EXPECT_TRUE(at >= 10 || dut.stream_base <= 1) << "written before the first answer was taken";
  }
  dut.s_axil_bready = 0;
  EXPECT_EQ(taken, 2);
  EXPECT_EQ(answers, 2);
  EXPECT_EQ(bench.read(0x10), 2u);
}

TEST(Registers, ControlGivesOnePulse) {
  Bench bench;
  for (uint32_t bits = 0; bits < 8; ++bits) {
    bench.loads = bench.disables = 0;
    bench.write(0x08, bits);
    EXPECT_EQ(bench.loads, static_cast<int>(bits & 1));
    EXPECT_EQ(bench.disables, static_cast<int>(bits >> 2));
  }
  bench.loads = 0;
  bench.write(0x08, 7, 0xE);
  EXPECT_EQ(bench.loads, 0) << "byte 0 was not written";
  EXPECT_EQ(bench.read(0x08), 0u);
}

// The high word that goes with a low word is read after it, whatever happens between.
TEST(Registers, LowWordKeepsItsHighWord) {
  Bench bench;
  bench.give_error(19, 0xAAAAAAAA00000001u);
  EXPECT_EQ(bench.read(0x38), 1u);
  bench.write(0x08, 2);
  bench.give_error(22, 0xBBBBBBBB00000002u);
  EXPECT_EQ(bench.read(0x40), 0u) << "another pair";
  EXPECT_EQ(bench.read(0x44), 0u);
  EXPECT_EQ(bench.read(0x3C), 0xAAAAAAAAu) << "of the low word that was read";
  EXPECT_EQ(bench.read(0x3C), 0xBBBBBBBBu) << "kept for one read";
}

}  // namespace
}  // namespace hmlfc::test
