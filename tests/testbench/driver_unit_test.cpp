// The part of the C driver that talks to a unit, against one of registers alone that does every
// descriptor at once: what it is told, and what it says of wrong arguments.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <map>

#include "bits/little_endian.hpp"
#include "driver/hmlfc_driver.h"
#include "driver/hmlfc_registers.h"
#include "stimulus/random_stream.hpp"
#include "unit/registers.hpp"
#include "view/descriptor.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint64_t kBus = 0x12'3456'7800;  // of the rings

class PlainUnit {
 public:
  explicit PlainUnit(unsigned ring_size)
      : ring_size_(ring_size), rings_(HMLFC_RINGS_BYTES(ring_size), 0xab) {
    registers[HMLFC_REG_ID] = HMLFC_REG_ID_RESET;
    registers[HMLFC_REG_VIEW_ID] = HMLFC_REG_VIEW_ID_RESET;
    registers[HMLFC_REG_PARAMETERS] = reg::parameters(2, 12, 16);
  }

  int open() { return open(buffer()); }
  int open(const hmlfc_buffer& rings) {
    const hmlfc_io io{this,
                      [](void* of, uint32_t at) { return self(of).registers[at]; },
                      [](void* of, uint32_t at, uint32_t value) { self(of).write(at, value); },
                      [](void* of) { return ++self(of).waits > 100 ? 1 : 0; },
                      [](void* of, const void*, size_t bytes) { self(of).cleaned += bytes; },
                      [](void* of, const void* from, size_t bytes) {
                        const auto* first = static_cast<const uint8_t*>(from);
                        EXPECT_EQ((first - self(of).rings_.data()) % HMLFC_CACHE_LINE, 0);
                        self(of).invalid += bytes;
                      }};
    return hmlfc_unit_open(&unit, &io, &rings, ring_size_);
  }
  hmlfc_buffer buffer() { return {rings_.data(), kBus, rings_.size()}; }

  /// Descriptor number `number`, which must still be in the ring.
  std::array<uint32_t, 16> words(unsigned number) const {
    std::array<uint32_t, 16> words{};
    std::memcpy(words.data(), rings_.data() + number % ring_size_ * 64, 64);
    return words;
  }
  uint64_t pair(uint32_t at) { return registers[at] | uint64_t{registers[at + 4]} << 32; }

  hmlfc_unit unit{};
  std::map<uint32_t, uint32_t> registers;
  std::vector<std::array<uint32_t, 16>> given;
  std::deque<hmlfc_status> answers;  ///< to the next descriptors; after them, done without errors
  bool answering = true;
  size_t cleaned = 0, invalid = 0;
  unsigned waits = 0, resets = 0;

 private:
  static PlainUnit& self(void* unit) { return *static_cast<PlainUnit*>(unit); }

  void write(uint32_t at, uint32_t value) {
    if (at == HMLFC_REG_INTERRUPT_STATUS) value = registers[at] & ~value;
    registers[at] = value;
    if (at == HMLFC_REG_VIEW_CONTROL && (value & HMLFC_REG_VIEW_CONTROL_RESET_MASK) != 0) {
      ++resets;
      registers[HMLFC_REG_CONSUMER] = 0;
    }
    if (at != HMLFC_REG_PRODUCER) return;
    given.push_back(words(value - 1));
    if (answering) answer(value - 1);
  }

  void answer(uint32_t number) {
    hmlfc_status status{given.back()[0], HMLFC_DONE, 0, 0, 0};
    if (!answers.empty()) {
      status = answers.front();
      answers.pop_front();
    }
    const std::array<uint32_t, 4> words{status.tag,
                                        status.result | uint32_t{status.first_error} << 8,
                                        status.blocks, status.writes};
    std::memcpy(rings_.data() + 64 * ring_size_ + number % ring_size_ * 16, words.data(), 16);
    registers[HMLFC_REG_CONSUMER] = (number + 1) & 0xffff;
  }

  unsigned ring_size_;
  std::vector<uint8_t> rings_;
};

TEST(DriverUnit, OpensAUnitAndSaysWhatIsWrong) {
  for (const unsigned size : {1u, 4u, 32768u}) {
    PlainUnit unit(size);
    EXPECT_EQ(unit.open(), HMLFC_OK);
    EXPECT_EQ(unit.pair(HMLFC_REG_RING_BASE), kBus);
    EXPECT_EQ(unit.pair(HMLFC_REG_STATUS_BASE), kBus + uint64_t{64} * size);
    EXPECT_EQ(unit.registers[HMLFC_REG_RING_SIZE], size);
    EXPECT_EQ(unit.registers[HMLFC_REG_VIEW_CONTROL], HMLFC_REG_VIEW_CONTROL_ENABLE_MASK);
    EXPECT_EQ(unit.resets, 1u);
    EXPECT_EQ(unit.cleaned, HMLFC_RINGS_BYTES(size));
    EXPECT_EQ(unit.invalid, HMLFC_RINGS_BYTES(size));
    EXPECT_EQ(*(unit.buffer().cpu + HMLFC_RINGS_BYTES(size) - 1), 0);
    const hmlfc_limits& limits = unit.unit.limits;
    EXPECT_EQ(limits.grid_side, 1024u);
    EXPECT_EQ(limits.view_side, 16384u);
    EXPECT_EQ(limits.tree_height, 7);
    EXPECT_EQ(limits.depth, 12);
    EXPECT_EQ(limits.block_log2, 2);
  }
  for (const unsigned size : {0u, 3u, 65536u}) {
    EXPECT_EQ(PlainUnit(size).open(), HMLFC_BAD_ARGUMENT) << size;
  }
  PlainUnit unit(4);
  hmlfc_buffer small = unit.buffer();
  --small.bytes;
  EXPECT_EQ(unit.open(small), HMLFC_BAD_ARGUMENT);
  hmlfc_buffer odd = unit.buffer();
  odd.bus += 32;
  EXPECT_EQ(unit.open(odd), HMLFC_BAD_ARGUMENT);
  hmlfc_buffer high = unit.buffer();
  high.bus = uint64_t{1} << 40;
  EXPECT_EQ(unit.open(high), HMLFC_BAD_ARGUMENT);
  for (const uint32_t id : {HMLFC_REG_ID, HMLFC_REG_VIEW_ID}) {
    PlainUnit other(4);
    other.registers[id] ^= 1;
    EXPECT_EQ(other.open(), HMLFC_NO_UNIT);
  }
}

TEST(DriverUnit, LoadsAStream) {
  PlainUnit unit(4);
  ASSERT_EQ(unit.open(), HMLFC_OK);
  hmlfc_stream stream{};
  stream.bytes = 1001;
  stream.area_bytes = 256;
  const uint64_t top = uint64_t{1} << 40;
  const auto load = [&](uint64_t stream_bus, uint64_t area_bus, size_t area_bytes) {
    const hmlfc_buffer area{nullptr, area_bus, area_bytes};
    return hmlfc_unit_load(&unit.unit, &stream, stream_bus, &area);
  };
  EXPECT_EQ(load(0xab'0000'0010, 0x80, 256), HMLFC_OK);
  EXPECT_EQ(unit.pair(HMLFC_REG_STREAM_BASE), 0xab'0000'0010u);
  EXPECT_EQ(unit.pair(HMLFC_REG_STREAM_BYTES), 1001u);
  EXPECT_EQ(unit.pair(HMLFC_REG_REFERENCE_BASE), 0x80u);
  EXPECT_EQ(unit.registers[HMLFC_REG_CONTROL], HMLFC_REG_CONTROL_LOAD_MASK);
  EXPECT_EQ(unit.cleaned - HMLFC_RINGS_BYTES(4), 1257u);
  EXPECT_EQ(load(8, 0x80, 256), HMLFC_BAD_ARGUMENT);
  EXPECT_EQ(load(0, 0x40, 256), HMLFC_BAD_ARGUMENT);
  EXPECT_EQ(load(0, 0x80, 255), HMLFC_BAD_ARGUMENT);
  EXPECT_EQ(load(0, 0x80, 304), HMLFC_OK);
  EXPECT_EQ(load(0, top - 384, 384), HMLFC_OK);
  EXPECT_EQ(load(0, top - 384, 385), HMLFC_BAD_ARGUMENT);
  EXPECT_EQ(load(top - 1040, 0x80, 256), HMLFC_OK);
  EXPECT_EQ(load(top - 1024, 0x80, 256), HMLFC_BAD_ARGUMENT);
  EXPECT_EQ(load(top, 0x80, 256), HMLFC_BAD_ARGUMENT);
  unit.registers[HMLFC_REG_STATUS] = 24u << HMLFC_REG_STATUS_LOAD_ERROR_SHIFT;
  EXPECT_EQ(load(0, 0x80, 256), HMLFC_LIMIT_EXCEEDED);
  unit.registers[HMLFC_REG_STATUS] = HMLFC_REG_STATUS_LOADING_MASK;
  EXPECT_EQ(load(0, 0x80, 256), HMLFC_TIMEOUT);
}

TEST(DriverUnit, OpensAUnitThatIsAtWork) {
  PlainUnit unit(4);
  hmlfc_status status{};
  for (uint32_t i = 0; i < 3; ++i) {
    ASSERT_EQ(unit.open(), HMLFC_OK);
    hmlfc_descriptor d{};
    d.tag = i;
    for (int k = 0; k < 3; ++k) EXPECT_EQ(hmlfc_unit_give(&unit.unit, &d), HMLFC_OK);
    EXPECT_EQ(hmlfc_unit_take(&unit.unit, &status), HMLFC_OK);
    EXPECT_EQ(status.tag, i);
  }
}

TEST(DriverUnit, GivesDescriptorsAndTakesTheirStatus) {
  PlainUnit unit(2);
  ASSERT_EQ(unit.open(), HMLFC_OK);
  unit.answering = false;
  hmlfc_descriptor d{0x89ab'cdef,    0xabc,     0xdef,         7, 6, 0x8765, 0x4321, 0xfedc, 0xcba9,
                     0x98'7654'3210, 0xff'fff0, 0xab'cdef'0128};
  EXPECT_EQ(hmlfc_unit_give(&unit.unit, &d), HMLFC_OK);
  const Descriptor same{d.tag,   d.row,   d.col,   7,        ViewFormat::kRgb161616,
                        d.x,     d.y,     d.width, d.height, d.destination,
                        d.pitch, d.bitmap};
  EXPECT_EQ(unit.cleaned - HMLFC_RINGS_BYTES(2), 64u);
  for (int field = 0; field < 4; ++field) {
    hmlfc_descriptor wide = d;
    if (field == 0) wide.row = 0x1000;
    if (field == 1) wide.col = 0x1000;
    if (field == 2) wide.stop_level = 16;
    if (field == 3) wide.format = 16;
    EXPECT_EQ(hmlfc_unit_give(&unit.unit, &wide), HMLFC_BAD_ARGUMENT) << field;
  }
  hmlfc_status status{};
  EXPECT_EQ(hmlfc_unit_take(&unit.unit, &status), HMLFC_NOTHING_DONE);
  EXPECT_EQ(hmlfc_unit_wait(&unit.unit, &status), HMLFC_TIMEOUT);
  EXPECT_EQ(hmlfc_unit_give(&unit.unit, &d), HMLFC_OK);
  EXPECT_EQ(hmlfc_unit_give(&unit.unit, &d), HMLFC_RING_FULL);
  ASSERT_EQ(unit.given.size(), 2u);
  for (const auto& words : unit.given) {
    std::array<uint32_t, 16> expected{};
    std::ranges::copy(same.words(), expected.begin());
    EXPECT_EQ(words, expected);
  }
  EXPECT_EQ(unit.registers[HMLFC_REG_PRODUCER], 2u);
}

TEST(DriverUnit, TakesStatusesInOrderAroundTheEndOfTheCount) {
  PlainUnit unit(4);
  ASSERT_EQ(unit.open(), HMLFC_OK);
  for (uint32_t i = 0; i < 70'000; ++i) {
    const hmlfc_status sent{i, static_cast<uint8_t>(i % 5), static_cast<uint8_t>(i % 64),
                            0x0102'0304 * (i + 1), ~i};
    unit.answers.push_back(sent);
    hmlfc_descriptor d{};
    ASSERT_EQ(hmlfc_unit_give(&unit.unit, &d), HMLFC_OK);
    hmlfc_status got{};
    ASSERT_EQ(i % 2 == 0 ? hmlfc_unit_wait(&unit.unit, &got) : hmlfc_unit_take(&unit.unit, &got),
              HMLFC_OK);
    ASSERT_EQ(got.tag, sent.tag);
    ASSERT_EQ(got.result, sent.result);
    ASSERT_EQ(got.first_error, sent.first_error);
    ASSERT_EQ(got.blocks, sent.blocks);
    ASSERT_EQ(got.writes, sent.writes);
    ASSERT_EQ(hmlfc_unit_wait(&unit.unit, &got), HMLFC_NOTHING_DONE);
  }
  EXPECT_EQ(unit.invalid, HMLFC_RINGS_BYTES(4) + size_t{70'000} * HMLFC_CACHE_LINE);
}

TEST(DriverUnit, StopsAndHandlesEvents) {
  PlainUnit unit(4);
  ASSERT_EQ(unit.open(), HMLFC_OK);
  EXPECT_EQ(hmlfc_unit_drain(&unit.unit), HMLFC_OK);
  EXPECT_EQ(unit.registers[HMLFC_REG_VIEW_CONTROL],
            HMLFC_REG_VIEW_CONTROL_ENABLE_MASK | HMLFC_REG_VIEW_CONTROL_DRAIN_MASK);
  EXPECT_EQ(hmlfc_unit_abort(&unit.unit), HMLFC_OK);
  EXPECT_EQ(unit.registers[HMLFC_REG_VIEW_CONTROL], HMLFC_REG_VIEW_CONTROL_ABORT_MASK);
  for (const uint32_t bit :
       {HMLFC_REG_VIEW_STATUS_DRAINING_MASK, HMLFC_REG_VIEW_STATUS_ENABLED_MASK}) {
    unit.registers[HMLFC_REG_VIEW_STATUS] = bit;
    EXPECT_EQ(hmlfc_unit_drain(&unit.unit), HMLFC_TIMEOUT);
  }
  for (const uint32_t bit :
       {HMLFC_REG_VIEW_STATUS_ABORTING_MASK, HMLFC_REG_VIEW_STATUS_ENABLED_MASK}) {
    unit.registers[HMLFC_REG_VIEW_STATUS] = bit;
    EXPECT_EQ(hmlfc_unit_abort(&unit.unit), HMLFC_TIMEOUT);
  }
  unit.waits = 0;
  unit.registers[HMLFC_REG_VIEW_STATUS] |= HMLFC_REG_VIEW_STATUS_HUNG_MASK;
  EXPECT_EQ(hmlfc_unit_abort(&unit.unit), HMLFC_TIMEOUT);
  EXPECT_EQ(unit.waits, 1u) << "the watchdog is believed";
  hmlfc_unit_set_watchdog(&unit.unit, 77);
  unit.registers[HMLFC_REG_VIEW_STATUS] = unit.registers[HMLFC_REG_WATCHDOG] = 0;
  EXPECT_EQ(hmlfc_unit_reset(&unit.unit), HMLFC_OK);
  EXPECT_EQ(unit.registers[HMLFC_REG_WATCHDOG], 77u);
  unit.registers[HMLFC_REG_VIEW_STATUS] = HMLFC_REG_VIEW_STATUS_RESETTING_MASK;
  EXPECT_EQ(hmlfc_unit_reset(&unit.unit), HMLFC_TIMEOUT);
  hmlfc_unit_enable_events(&unit.unit, 5);
  EXPECT_EQ(unit.registers[HMLFC_REG_INTERRUPT_ENABLE], 5u);
  unit.registers[HMLFC_REG_INTERRUPT_STATUS] = 9;
  EXPECT_EQ(hmlfc_unit_events(&unit.unit), 9u);
  EXPECT_EQ(unit.registers[HMLFC_REG_INTERRUPT_STATUS], 0u);
}

TEST(DriverUnit, ReportsResidualsThatCouldNotBeWritten) {
  const auto file = suite_stream(1, 4);
  hmlfc_stream stream;
  hmlfc_error error;
  ASSERT_EQ(hmlfc_stream_open(&stream, file.data(), file.size(), nullptr, &error), HMLFC_OK);
  stream.levels[0].keyed = 0;
  stream.levels[0].is_read = 1;
  const hmlfc_buffer area{nullptr, 0, stream.area_bytes};
  uint64_t failed = 0;
  for (const uint8_t result : {HMLFC_REFUSED, HMLFC_BUS, HMLFC_ABORTED}) {
    PlainUnit unit(2);
    ASSERT_EQ(unit.open(), HMLFC_OK);
    unit.answers = {{0, HMLFC_DONE, 0, 0, 0}, {0, result, 0, 0, 1}};
    EXPECT_EQ(hmlfc_unit_fill_residuals(&unit.unit, &stream, &area, &failed),
              result == HMLFC_REFUSED ? HMLFC_WAS_REFUSED : HMLFC_BUS_ERROR);
    EXPECT_EQ(unit.unit.taken, unit.unit.producer) << "in flight";
    const hmlfc_buffer small{nullptr, 0, stream.area_bytes - 1};
    EXPECT_EQ(hmlfc_unit_fill_residuals(&unit.unit, &stream, &small, &failed), HMLFC_BAD_ARGUMENT);
    hmlfc_descriptor d{};
    EXPECT_EQ(hmlfc_unit_give(&unit.unit, &d), HMLFC_OK);
    EXPECT_EQ(hmlfc_unit_fill_residuals(&unit.unit, &stream, &area, &failed), HMLFC_BUSY);
  }
  PlainUnit silent(2);
  ASSERT_EQ(silent.open(), HMLFC_OK);
  silent.answering = false;
  EXPECT_EQ(hmlfc_unit_fill_residuals(&silent.unit, &stream, &area, &failed), HMLFC_TIMEOUT);
  EXPECT_EQ(silent.resets, 2u) << "nothing is in flight";
}

}  // namespace
}  // namespace hmlfc::tb
