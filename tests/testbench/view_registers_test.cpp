// The register port of the view unit: its five channels go on independently of each other, to the
// registers of the decode unit and to those of the DMA.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <utility>

#include "driver/hmlfc_registers.h"
#include "unit/units.hpp"
#include "vectors/random.hpp"

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
constexpr std::array<Kept, 16> kKept{
    {{HMLFC_REG_STREAM_BASE, low(HMLFC_REG_STREAM_BASE_MASK)},
     {HMLFC_REG_STREAM_BASE_HIGH, high(HMLFC_REG_STREAM_BASE_MASK)},
     {HMLFC_REG_REFERENCE_BASE, low(HMLFC_REG_REFERENCE_BASE_MASK)},
     {HMLFC_REG_REFERENCE_BASE_HIGH, high(HMLFC_REG_REFERENCE_BASE_MASK)},
     {HMLFC_REG_RING_BASE, low(HMLFC_REG_RING_BASE_MASK)},
     {HMLFC_REG_RING_BASE_HIGH, high(HMLFC_REG_RING_BASE_MASK)},
     {HMLFC_REG_STATUS_BASE, low(HMLFC_REG_STATUS_BASE_MASK)},
     {HMLFC_REG_STATUS_BASE_HIGH, high(HMLFC_REG_STATUS_BASE_MASK)},
     {HMLFC_REG_STREAM_BYTES, ~0u},
     {HMLFC_REG_STREAM_BYTES_HIGH, ~0u},
     {HMLFC_REG_RING_SIZE, HMLFC_REG_RING_SIZE_MASK},
     {HMLFC_REG_PRODUCER, HMLFC_REG_PRODUCER_MASK},
     {HMLFC_REG_INTERRUPT_ENABLE, HMLFC_REG_INTERRUPT_ENABLE_MASK},
     {HMLFC_REG_WATCHDOG, HMLFC_REG_WATCHDOG_MASK},
     {0x028, 0},  // no registers
     {0x834, 0}}};

// Each channel offers its next access after a wait of its own, whether or not those before it are
// answered. No read is under way together with a write of the same register, so that the value that
// is read is known.
class Traffic {
 public:
  Traffic(Unit& unit, uint64_t seed) : unit_(unit), random_(seed) {
    for (int i = 0; i < 4; ++i) unit_.clock(in_, out_);
    in_.rst_n = true;
  }

  void run(int clocks) {
    for (int i = 0; i < clocks && !testing::Test::HasFailure(); ++i) {
      begin();
      offer();
      const bool answer_stays = out_.b_valid && !took_answer_;
      const bool data_stay = out_.lite_r_valid && !took_data_;
      unit_.clock(in_, out_);
      EXPECT_TRUE(out_.b_valid || !answer_stays) << "BVALID falls";
      EXPECT_TRUE(out_.lite_r_valid || !data_stay) << "RVALID falls";
      take_write();
      take_read();
    }
  }

  int writes() const { return answered_; }
  int reads() const { return read_; }

 private:
  static constexpr size_t kMost = 3;  // accesses under way in each direction

  struct Access {
    size_t index = 0;  // in kKept
    uint32_t data = 0;
    uint8_t strobes = 0;
    bool addressed = false;
    bool sent = false;
  };
  using Accesses = std::deque<Access>;

  static bool holds(const Accesses& accesses, size_t index) {
    return std::ranges::find(accesses, index, &Access::index) != accesses.end();
  }

  void begin() {
    for (auto [own, other] : {std::pair{&writes_, &reads_}, std::pair{&reads_, &writes_}}) {
      const Access access{random_.below(kKept.size()), static_cast<uint32_t>(random_.next()),
                          static_cast<uint8_t>(random_.below(16))};
      if (own->size() < kMost && random_.chance(300) && !holds(*other, access.index)) {
        own->push_back(access);
      }
    }
  }

  // What is offered stays until it is taken.
  void offer() {
    aw_ = std::ranges::find(writes_, false, &Access::addressed);
    w_ = std::ranges::find(writes_, false, &Access::sent);
    ar_ = std::ranges::find(reads_, false, &Access::addressed);
    in_.aw_valid = aw_ != writes_.end() && (in_.aw_valid || random_.chance(300));
    in_.w_valid = w_ != writes_.end() && (in_.w_valid || random_.chance(300));
    in_.lite_ar_valid = ar_ != reads_.end() && (in_.lite_ar_valid || random_.chance(300));
    if (in_.aw_valid) in_.aw_addr = kKept[aw_->index].offset;
    if (in_.w_valid) in_.w_data = w_->data;
    if (in_.w_valid) in_.w_strb = w_->strobes;
    if (in_.lite_ar_valid) in_.lite_ar_addr = kKept[ar_->index].offset;
    in_.b_ready = random_.chance(300);
    in_.lite_r_ready = random_.chance(300);
  }

  // A handshake seen now completes at the next clock edge.
  void take_write() {
    took_answer_ = out_.b_valid && in_.b_ready;
    if (in_.aw_valid && out_.aw_ready) aw_->addressed = true;
    if (in_.w_valid && out_.w_ready) w_->sent = true;
    in_.aw_valid = in_.aw_valid && !out_.aw_ready;
    in_.w_valid = in_.w_valid && !out_.w_ready;
    if (!out_.b_valid) return;
    ASSERT_FALSE(writes_.empty()) << "an answer to no write";
    const Access write = writes_.front();
    EXPECT_TRUE(write.addressed && write.sent) << "an answer to no write";
    if (!took_answer_) return;
    uint32_t bytes = 0;
    for (unsigned k = 0; k < 4; ++k) bytes |= (write.strobes >> k & 1u) * (0xffu << 8 * k);
    uint32_t& value = values_[write.index];
    value = ((value & ~bytes) | (write.data & bytes)) & kKept[write.index].mask;
    writes_.pop_front();
    ++answered_;
  }

  void take_read() {
    took_data_ = out_.lite_r_valid && in_.lite_r_ready;
    if (in_.lite_ar_valid && out_.lite_ar_ready) ar_->addressed = true;
    in_.lite_ar_valid = in_.lite_ar_valid && !out_.lite_ar_ready;
    if (!out_.lite_r_valid) return;
    ASSERT_FALSE(reads_.empty()) << "an answer to no read";
    const Access read = reads_.front();
    EXPECT_TRUE(read.addressed) << "an answer to no read";
    EXPECT_EQ(out_.lite_r_data, values_[read.index]) << std::hex << kKept[read.index].offset;
    if (!took_data_) return;
    reads_.pop_front();
    ++read_;
  }

  Unit& unit_;
  vectors::Random random_;
  UnitInputs in_;
  UnitOutputs out_;
  std::array<uint32_t, kKept.size()> values_{};
  Accesses writes_;
  Accesses reads_;
  Accesses::iterator aw_, w_, ar_;
  bool took_answer_ = false;
  bool took_data_ = false;
  int answered_ = 0;
  int read_ = 0;
};

TEST(ViewUnit, RegistersByIndependentChannels) {
  for (const UnitMaker& maker : view_units()) {
    const auto unit = maker.make(maker.parameters, nullptr);
    Traffic traffic(*unit, 1);
    traffic.run(20'000);
    EXPECT_GT(traffic.writes(), 500);
    EXPECT_GT(traffic.reads(), 500);
  }
}

}  // namespace
}  // namespace hmlfc::tb
