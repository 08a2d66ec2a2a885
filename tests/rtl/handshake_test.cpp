// hmlfc_fifo and hmlfc_skid_buffer against a queue, under random traffic.
#include <array>
#include <deque>

#include <Fifo.h>
#include <FifoDepths.h>
#include <SkidBuffer.h>

#include "rtl/ports.hpp"

namespace hmlfc::test {
namespace {

template <class Dut>
void reset_idle(Dut& dut) {
  dut.in_valid = 0;
  dut.out_ready = 0;
  reset(dut);
  dut.eval();
}

// Random valid and ready, each at a rate that changes: words come out once each, in order, and an
// offered word stays until it is taken. `inside(dut, words)` checks what else is known.
template <class Dut, class Inside>
Counts traffic(Dut& dut, Inside&& inside) {
  Random random(10);
  Counts counts;
  std::deque<int> queue;
  reset_idle(dut);
  int put_rate = 2, take_rate = 2;
  bool waiting = false;
  for (int clock = 0; clock < 200000; ++clock) {
    if (clock % 64 == 0) {
      put_rate = random.in(1, 5);
      take_rate = random.in(1, 5);
    }
    if (!waiting) {
      dut.in_valid = random.in(1, 5) <= put_rate;
      dut.in_data = static_cast<uint8_t>(random.in(0, 255));
    }
    dut.out_ready = random.in(1, 5) <= take_rate;
    dut.clk = 0;
    dut.eval();
    inside(dut, queue.size());
    counts.compare(dut.out_valid, queue.empty() ? 0 : 1);
    if (dut.out_valid && !queue.empty()) counts.compare(dut.out_data, queue.front());
    const bool put = dut.in_valid && dut.in_ready;
    const bool take = dut.out_valid && dut.out_ready;
    waiting = dut.in_valid && !put;
    if (take && !queue.empty()) queue.pop_front();
    if (put) queue.push_back(dut.in_data);
    dut.clk = 1;
    dut.eval();
  }
  return counts;
}

TEST(Fifo, RandomTraffic) {
  Fifo dut;
  Counts extra;
  const Counts counts = traffic(dut, [&](const Fifo& fifo, size_t words) {
    extra.compare(fifo.count, static_cast<int64_t>(words));
    extra.compare(fifo.in_ready, words < 4 ? 1 : 0);
  });
  expect_equal(counts, 200000);
  expect_equal(extra, 400000);
}

// Every depth that OUTSTANDING may have: each queue fills and empties many times.
TEST(Fifo, EveryDepth) {
  constexpr unsigned kQueues = 61, kLeast = 4;
  FifoDepths dut;
  dut.in_valid = dut.out_ready = 0;
  reset(dut);
  Random random(12);
  Counts counts;
  std::array<std::deque<uint32_t>, kQueues> queues;
  std::array<int, kQueues> times_full{};
  bool fills = true;
  for (int clock = 0; clock < 40000; ++clock) {
    if (clock % 200 == 0) fills = !fills;
    dut.in_data = static_cast<uint8_t>(random.in(0, 255));
    for (unsigned i = 0; i < kQueues; ++i) {
      put_bits(dut.in_valid, i, 1, fills || random.one_in(8));
      put_bits(dut.out_ready, i, 1, !fills || random.one_in(8));
    }
    dut.clk = 0;
    dut.eval();
    for (unsigned i = 0; i < kQueues; ++i) {
      std::deque<uint32_t>& queue = queues[i];
      const bool full = queue.size() == kLeast + i;
      const bool put = get_bits(dut.in_valid, i, 1) != 0 && !full;
      const bool take = get_bits(dut.out_ready, i, 1) != 0 && !queue.empty();
      counts.compare(get_bits(dut.count, 7 * size_t{i}, 7), static_cast<int64_t>(queue.size()));
      counts.compare(get_bits(dut.in_ready, i, 1), full ? 0 : 1);
      counts.compare(get_bits(dut.out_valid, i, 1), queue.empty() ? 0 : 1);
      if (!queue.empty()) {
        counts.compare(get_bits(dut.out_data, 8 * size_t{i}, 8), queue.front());
      }
      times_full[i] += full;
      if (take) queue.pop_front();
      if (put) queue.push_back(dut.in_data);
    }
    dut.clk = 1;
    dut.eval();
  }
  for (unsigned i = 0; i < kQueues; ++i) EXPECT_GE(times_full[i], 1000) << kLeast + i;
  expect_equal(counts, 40000 * uint64_t{kQueues} * 3);
}

TEST(SkidBuffer, RandomTraffic) {
  SkidBuffer dut;
  Counts extra;
  const Counts counts = traffic(dut, [&](const SkidBuffer& slice, size_t words) {
    extra.compare(slice.in_ready, words < 2 ? 1 : 0);
    // From registers: ready must not follow the other side within a clock.
    SkidBuffer& changed = dut;
    const auto ready = changed.out_ready;
    changed.out_ready = !ready;
    changed.eval();
    extra.compare(changed.in_ready, words < 2 ? 1 : 0);
    changed.out_ready = ready;
    changed.eval();
  });
  expect_equal(counts, 200000);
  expect_equal(extra, 400000);
}

// Words a clock with a sender and a receiver that never wait.
template <class Dut>
int words_in(Dut& dut, int clocks) {
  reset_idle(dut);
  dut.in_valid = 1;
  dut.out_ready = 1;
  int words = 0;
  for (int clock = 0; clock < clocks; ++clock) {
    tick(dut);
    if (dut.out_valid) ++words;
  }
  return words;
}

TEST(Fifo, OneWordAClock) {
  Fifo dut;
  EXPECT_EQ(words_in(dut, 100), 100);
}

TEST(SkidBuffer, OneWordAClock) {
  SkidBuffer dut;
  EXPECT_EQ(words_in(dut, 100), 100);
}

TEST(Fifo, ResetEmpties) {
  Fifo dut;
  words_in(dut, 3);
  reset_idle(dut);
  EXPECT_EQ(dut.count, 0);
  EXPECT_FALSE(dut.out_valid);
  EXPECT_TRUE(dut.in_ready);
}

TEST(SkidBuffer, ResetEmpties) {
  SkidBuffer dut;
  reset_idle(dut);
  dut.in_valid = 1;
  for (int clock = 0; clock < 3; ++clock) tick(dut);
  EXPECT_FALSE(dut.in_ready);
  reset_idle(dut);
  EXPECT_FALSE(dut.out_valid);
  EXPECT_TRUE(dut.in_ready);
}

}  // namespace
}  // namespace hmlfc::test
