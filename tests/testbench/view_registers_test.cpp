// The register port of the view unit: its five channels go on independently of each other, to the
// registers of the decode unit and to those of the DMA.
#include <gtest/gtest.h>

#include <array>

#include "driver/hmlfc_registers.h"
#include "oracle/oracle.hpp"
#include "vectors/random.hpp"
#include "view/view_units.hpp"

namespace hmlfc::tb {
namespace {

struct Kept {
  uint32_t offset = 0;
  uint32_t mask = 0;
};
constexpr uint32_t low(uint64_t mask) { return static_cast<uint32_t>(mask); }
constexpr uint32_t high(uint64_t mask) { return static_cast<uint32_t>(mask >> 32); }

// Registers that keep what is written, with the bits they have: of the decode unit, then of the
// DMA.
constexpr std::array<Kept, 8> kKept{
    {{HMLFC_REG_STREAM_BASE, low(HMLFC_REG_STREAM_BASE_MASK)},
     {HMLFC_REG_STREAM_BASE_HIGH, high(HMLFC_REG_STREAM_BASE_MASK)},
     {HMLFC_REG_REFERENCE_BASE, low(HMLFC_REG_REFERENCE_BASE_MASK)},
     {HMLFC_REG_REFERENCE_BASE_HIGH, high(HMLFC_REG_REFERENCE_BASE_MASK)},
     {HMLFC_REG_RING_BASE, low(HMLFC_REG_RING_BASE_MASK)},
     {HMLFC_REG_RING_BASE_HIGH, high(HMLFC_REG_RING_BASE_MASK)},
     {HMLFC_REG_STATUS_BASE, low(HMLFC_REG_STATUS_BASE_MASK)},
     {HMLFC_REG_STATUS_BASE_HIGH, high(HMLFC_REG_STATUS_BASE_MASK)}}};

// One write and one read at a time, each channel after a wait of its own, and never both of the
// same register, so that the value that is read is known.
class Traffic {
 public:
  Traffic(ViewUnit& unit, uint64_t seed) : unit_(unit), random_(seed) {
    for (int i = 0; i < 4; ++i) unit_.clock(in_, out_);
    in_.rst_n = true;
    in_.w_strb = 15;
  }

  void run(int clocks) {
    for (int i = 0; i < clocks && !testing::Test::HasFailure(); ++i) {
      offer_write();
      offer_read();
      unit_.clock(in_, out_);
      take_write();
      take_read();
    }
  }

  int writes() const { return writes_; }
  int reads() const { return reads_; }

 private:
  enum class Access : uint8_t { kNone, kUnderWay, kAnswered };

  void offer_write() {
    if (!writing_ && random_.chance(500)) {
      written_ = random_.below(kKept.size());
      writing_ = !reading_ || written_ != read_;
      address_passed_ = data_passed_ = false;
      in_.aw_addr = kKept[written_].offset;
      in_.w_data = static_cast<uint32_t>(random_.next());
    }
    in_.aw_valid = writing_ && !address_passed_ && (in_.aw_valid || random_.chance(300));
    in_.w_valid = writing_ && !data_passed_ && (in_.w_valid || random_.chance(300));
    in_.b_ready = random_.chance(300);
  }

  void offer_read() {
    if (!reading_ && random_.chance(500)) {
      read_ = random_.below(kKept.size());
      reading_ = !writing_ || read_ != written_;
      asked_ = false;
      in_.lite_ar_addr = kKept[read_].offset;
    }
    in_.lite_ar_valid = reading_ && !asked_ && (in_.lite_ar_valid || random_.chance(300));
    in_.lite_r_ready = random_.chance(300);
  }

  // What is shown and taken now passes at the next edge.
  void take_write() {
    if (out_.b_valid) {
      EXPECT_TRUE(address_passed_ && data_passed_) << "an answer to no write";
      if (in_.b_ready) {
        values_[written_] = in_.w_data & kKept[written_].mask;
        writing_ = false;
        ++writes_;
      }
    }
    if (in_.aw_valid && out_.aw_ready) address_passed_ = true;
    if (in_.w_valid && out_.w_ready) data_passed_ = true;
  }

  void take_read() {
    if (out_.lite_r_valid) {
      EXPECT_TRUE(reading_ && asked_) << "an answer to no read";
      EXPECT_EQ(out_.lite_r_data, values_[read_]) << std::hex << kKept[read_].offset;
      if (in_.lite_r_ready) {
        reading_ = false;
        ++reads_;
      }
    }
    if (in_.lite_ar_valid && out_.lite_ar_ready) asked_ = true;
  }

  ViewUnit& unit_;
  vectors::Random random_;
  ViewInputs in_;
  ViewOutputs out_;
  std::array<uint32_t, kKept.size()> values_{};
  size_t written_ = 0;
  size_t read_ = 0;
  bool writing_ = false;
  bool address_passed_ = false;
  bool data_passed_ = false;
  bool reading_ = false;
  bool asked_ = false;
  int writes_ = 0;
  int reads_ = 0;
};

TEST(ViewUnit, RegistersByIndependentChannels) {
  for (const ViewMaker& maker : view_units()) {
    Oracle oracle(uint8_t{0});  // is not asked
    const auto unit = maker.make(maker.parameters, oracle, 0);
    Traffic traffic(*unit, 1);
    traffic.run(20'000);
    EXPECT_GT(traffic.writes(), 500);
    EXPECT_GT(traffic.reads(), 500);
  }
}

}  // namespace
}  // namespace hmlfc::tb
