// hmlfc_reference_cache against the samples of the planes that its memory holds as strips: order,
// borders, blocks with an error, replacement, bus errors.
#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include <ReferenceCache.h>

#include "oracle/reference_area.hpp"
#include "rtl/ports.hpp"
#include "rtl/read_port.hpp"

namespace hmlfc::test {
namespace {

constexpr unsigned kBlock = 4;
constexpr unsigned kSampleBits = 10;
constexpr int32_t kPeak = (1 << (kSampleBits - 1)) - 1;
constexpr unsigned kSide = kBlock + 1;
constexpr unsigned kBlocksOfStrip = tb::kStripSamples / (kBlock * kBlock);
constexpr uint8_t kBlockError = 19;  // one of annex A

/// A plane by chance: its samples, which of its blocks have an error, its strips in memory.
struct StripPlane {
  int32_t width = 0;
  int32_t height = 0;
  uint64_t address = 0;
  std::vector<int32_t> samples;  // row-major; of blocks with an error without meaning
  std::vector<bool> failed;      // blocks, row-major

  uint32_t blocks_x() const { return (static_cast<uint32_t>(width) + kBlock - 1) / kBlock; }
  uint32_t blocks_y() const { return (static_cast<uint32_t>(height) + kBlock - 1) / kBlock; }
  uint32_t strips_x() const { return tb::strips_in_row(static_cast<uint32_t>(width), kBlock); }

  int32_t sample(int32_t x, int32_t y) const {
    return samples[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

/// Strip `s` of row `by` of the plane.
tb::StripSamples strip_of(const StripPlane& plane, uint32_t s, uint32_t by) {
  tb::StripSamples strip{};
  for (uint32_t i = 0; i < tb::kStripSamples; ++i) {
    const uint32_t bx = s * kBlocksOfStrip + i / (kBlock * kBlock);
    if (bx >= plane.blocks_x()) continue;
    const auto x = static_cast<int32_t>(bx * kBlock + i % kBlock);
    const auto y = static_cast<int32_t>(by * kBlock + i / kBlock % kBlock);
    const bool inside = x < plane.width && y < plane.height;
    const bool failed = plane.failed[by * plane.blocks_x() + bx];
    strip[i] = failed   ? tb::poison_of(static_cast<ErrorCode>(kBlockError))
               : inside ? plane.sample(x, y)
                        : 0;
  }
  return strip;
}

/// A plane of at most 150 x 80 samples, appended to `memory`.
StripPlane some_plane(std::vector<uint8_t>& memory, Random& random) {
  StripPlane plane;
  plane.width = random.in(1, 150);
  plane.height = random.in(1, 80);
  plane.address = ReadPort::kBase + memory.size();
  const bool failing = random.one_in(3);
  for (int32_t i = 0; i < plane.width * plane.height; ++i) {
    plane.samples.push_back(random.often_extreme(-kPeak, kPeak));
  }
  for (uint32_t i = 0; i < plane.blocks_x() * plane.blocks_y(); ++i) {
    plane.failed.push_back(failing && random.one_in(20));
  }
  for (uint32_t by = 0; by < plane.blocks_y(); ++by) {
    for (uint32_t s = 0; s < plane.strips_x(); ++s) {
      const auto place = tb::pack_strip(strip_of(plane, s, by));
      memory.insert(memory.end(), place.begin(), place.end());
    }
  }
  return plane;
}

/// What a window must be: the plane's samples with coordinates clamped, or an error.
struct Window {
  uint8_t error = 0;
  std::array<int32_t, kSide * kSide> samples{};
};

Window expected_window(const StripPlane& plane, int32_t x, int32_t y, bool extra_x, bool extra_y) {
  Window window;
  const auto at = [](int32_t from, int32_t i, bool extra, int32_t size) {
    const bool last = i == static_cast<int32_t>(kBlock);
    return std::clamp(from + (last && !extra ? i - 1 : i), 0, size - 1);
  };
  for (int32_t j = 0; j < static_cast<int32_t>(kSide); ++j) {
    for (int32_t i = 0; i < static_cast<int32_t>(kSide); ++i) {
      const int32_t column = at(x, i, extra_x, plane.width);
      const int32_t row = at(y, j, extra_y, plane.height);
      const uint32_t block = static_cast<uint32_t>(row) / kBlock * plane.blocks_x() +
                             static_cast<uint32_t>(column) / kBlock;
      if (plane.failed[block]) window.error = kBlockError;
      window.samples[static_cast<size_t>(j) * kSide + static_cast<size_t>(i)] =
          plane.sample(column, row);
    }
  }
  return window;
}

template <class Dut>
class CacheRun {
 public:
  explicit CacheRun(uint32_t seed) : random_(seed), port_(memory_, random_) {
    for (auto& plane : planes_) plane = some_plane(memory_, random_);
    reset(dut_);
  }

  /// Sends `count` windows and waits for all of them.
  void run(int count, bool corrupt) {
    port_.corrupt = corrupt;
    int clocks = 0;
    for (int sent = 0; (sent < count || !expected_.empty()) && clocks < 200'000; ++clocks) {
      if (dut_.in_valid == 0 && sent < count && !random_.one_in(4)) offer();
      dut_.out_ready = !random_.one_in(3);
      port_.drive(dut_);
      dut_.eval();
      port_.watch(dut_);
      if (dut_.out_valid && dut_.out_ready) take(corrupt);
      const bool entered = dut_.in_valid && dut_.in_ready;
      tick(dut_);
      if (!entered) continue;
      expected_.push_back(offered_);
      dut_.in_valid = 0;
      ++sent;
    }
    EXPECT_TRUE(expected_.empty()) << "windows that never came";
    // A strip that a bus error corrupted is forgotten at the clock after its window.
    for (int i = 0; i < 4; ++i) tick(dut_);
  }

  uint64_t requests() const { return port_.requests; }
  const Counts& counts() const { return counts_; }
  uint64_t bus_errors() const { return bus_errors_; }
  uint64_t block_errors() const { return block_errors_; }

 private:
  void offer() {
    const auto p = static_cast<size_t>(random_.in(0, 2));
    const StripPlane& plane = planes_[p];
    const bool far = random_.one_in(4);
    const int32_t margin = far ? 200 : 6;
    const int32_t x =
        random_.one_in(2) ? near(x_, plane.width) : random_.in(-margin, plane.width + margin);
    const int32_t y =
        random_.one_in(2) ? near(y_, plane.height) : random_.in(-margin, plane.height + margin);
    x_ = x;
    y_ = y;
    dut_.in_valid = 1;
    dut_.in_address = plane.address;
    dut_.in_plane = static_cast<uint8_t>(p);
    dut_.in_section = random_.one_in(2);
    dut_.in_strips_x = static_cast<uint16_t>(plane.strips_x());
    dut_.in_width = static_cast<uint16_t>(plane.width);
    dut_.in_height = static_cast<uint16_t>(plane.height);
    dut_.in_x = static_cast<uint32_t>(x) & 0x1FFFF;
    dut_.in_y = static_cast<uint32_t>(y) & 0x1FFFF;
    dut_.in_extra_x = random_.one_in(2);
    dut_.in_extra_y = random_.one_in(2);
    offered_ = expected_window(plane, x, y, dut_.in_extra_x != 0, dut_.in_extra_y != 0);
  }

  int32_t near(int32_t at, int32_t size) {
    return std::clamp(at + random_.in(-4, 4), -8, size + 8);
  }

  void take(bool corrupt) {
    ASSERT_FALSE(expected_.empty()) << "a window too many";
    const Window expected = expected_.front();
    expected_.pop_front();
    if (corrupt && dut_.out_error == ReadPort::kBusError) {
      ++bus_errors_;
      return;
    }
    counts_.compare(dut_.out_error, expected.error);
    block_errors_ += expected.error != 0;
    for (size_t i = 0; expected.error == 0 && i < expected.samples.size(); ++i) {
      counts_.compare(get_signed(dut_.out_window, i * kSampleBits, kSampleBits),
                      expected.samples[i]);
    }
  }

  Random random_;
  std::vector<uint8_t> memory_;
  std::array<StripPlane, 3> planes_;
  ReadPort port_;
  Dut dut_;
  std::deque<Window> expected_;
  Window offered_;
  int32_t x_ = 0;
  int32_t y_ = 0;
  Counts counts_;
  uint64_t bus_errors_ = 0;
  uint64_t block_errors_ = 0;
};

TEST(ReferenceCache, GivesTheSamplesOfEachWindowInOrder) {
  uint64_t failed = 0;
  Counts counts;
  for (uint32_t seed = 0; seed < 12; ++seed) {
    CacheRun<ReferenceCache> run(seed);
    run.run(1500, false);
    counts.compared += run.counts().compared;
    counts.wrong += run.counts().wrong;
    failed += run.block_errors();
  }
  expect_equal(counts, 300'000);
  EXPECT_GT(failed, 100u) << "windows over a block with an error";
}

TEST(ReferenceCache, KeepsNothingOfABusError) {
  uint64_t bus_errors = 0;
  Counts counts;
  for (uint32_t seed = 20; seed < 28; ++seed) {
    CacheRun<ReferenceCache> run(seed);
    for (int turn = 0; turn < 8; ++turn) run.run(100, turn % 2 == 0);
    counts.compared += run.counts().compared;
    counts.wrong += run.counts().wrong;
    bus_errors += run.bus_errors();
  }
  expect_equal(counts, 50'000);
  EXPECT_GT(bus_errors, 100u);
}

}  // namespace
}  // namespace hmlfc::test
