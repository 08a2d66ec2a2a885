// hmlfc_fifo against a queue, under random traffic.
#include <array>
#include <deque>

#include <FifoDepths.h>

#include "rtl/ports.hpp"

namespace hmlfc::test {
namespace {

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

}  // namespace
}  // namespace hmlfc::test
