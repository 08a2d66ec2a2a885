// hmlfc_reconstruct against the model (DEC-3, EXT-5).
#include <array>
#include <deque>
#include <utility>

#include <Reconstruct2x8.h>
#include <Reconstruct3x12.h>

#include "arithmetic/reconstruct.hpp"
#include "rtl/ports.hpp"

namespace hmlfc::test {
namespace {

constexpr unsigned kLatency = 3;

struct Flags {
  bool motion, negative, keyed, has_residual, chroma;
};

Flags flags_of(unsigned bits) {
  return {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0};
}

SampleRange range_of(const Flags& flags, int depth) {
  return sample_range(flags.chroma ? Plane::kCo : Plane::kY, depth);
}

template <class Dut, unsigned kBlockLog2, int kMaxDepth>
class Bench {
 public:
  static constexpr unsigned kSamples = 1u << (2 * kBlockLog2);

  void put(unsigned i, int32_t parent, int32_t reference, int32_t residual) {
    inputs_[i] = {parent, reference, residual};
  }

  /// What was put, in two blocks: one of a key image, whose samples are the parents, and its child.
  void check(const Flags& flags, int depth) {
    dut_.depth = static_cast<uint8_t>(depth);
    dut_.chroma = flags.chroma;
    Block key;
    for (unsigned i = 0; i < kSamples; ++i) {
      put_bits(dut_.references, (kMaxDepth + 2) * i, kMaxDepth + 2, inputs_[i].parent);
      key.sample[i] = key.prediction[i] = inputs_[i].parent;
    }
    send(key, {false, flags.negative, flags.keyed, false, flags.chroma}, true);
    send(child(flags, depth), flags, false);
  }

  /// Blocks that are still inside come out.
  void finish() {
    while (!inside_.empty()) clock(true, false);
  }

  Counts counts;

 private:
  struct Input {
    int32_t parent, reference, residual;
  };
  struct Block {
    std::array<int32_t, kSamples> prediction{}, sample{};
  };

  Dut dut_;
  Random random_{10};
  std::array<Input, kSamples> inputs_{};
  /// Clock in which the oldest comes out, and the block.
  std::deque<std::pair<uint64_t, Block>> inside_;
  uint64_t clocks_ = 0;  ///< with advance
  Block out_;            ///< what came out last
  bool any_out_ = false;

  Block child(const Flags& flags, int depth) {
    const SampleRange range = range_of(flags, depth);
    Block block;
    for (unsigned i = 0; i < kSamples; ++i) {
      const auto& [parent, reference, residual] = inputs_[i];
      put_bits(dut_.references, (kMaxDepth + 2) * i, kMaxDepth + 2, reference);
      put_bits(dut_.residual, (kMaxDepth + 2) * i, kMaxDepth + 2, residual);
      const int32_t a = flags.motion ? motion_prediction(flags.keyed ? 0 : parent, flags.negative,
                                                         reference, range)
                                     : parent;
      block.prediction[i] = a;
      block.sample[i] = flags.has_residual ? add_residual(a, residual, range) : a;
    }
    return block;
  }

  // One clock in eight is without advance, one in eight without a block.
  void send(const Block& block, const Flags& flags, bool key) {
    dut_.key = key;
    dut_.chained = !key;
    dut_.motion = flags.motion;
    dut_.negative = flags.negative;
    dut_.keyed = flags.keyed;
    dut_.has_residual = flags.has_residual;
    while (random_.one_in(8)) clock(false, false);
    while (random_.one_in(8)) clock(true, false);
    inside_.emplace_back(clocks_ + kLatency, block);
    clock(true, true);
  }

  void clock(bool advance, bool valid) {
    dut_.advance = advance;
    dut_.valid = valid;
    tick(dut_);
    if (advance) ++clocks_;
    if (advance && !inside_.empty() && inside_.front().first == clocks_) {
      out_ = inside_.front().second;
      inside_.pop_front();
      any_out_ = true;
    }
    if (any_out_) compare();
  }

  // Held until the next block comes out.
  void compare() {
    for (unsigned i = 0; i < kSamples; ++i) {
      counts.compare(get_signed(dut_.prediction, (kMaxDepth + 1) * i, kMaxDepth + 1),
                     out_.prediction[i]);
      counts.compare(get_signed(dut_.sample, (kMaxDepth + 1) * i, kMaxDepth + 1), out_.sample[i]);
    }
  }
};

// Every parent with every reference, and every parent with every residual, in all states.
TEST(Reconstruct, EveryPairAtDepth8) {
  Bench<Reconstruct2x8, 2, 8> bench;
  Random random(1);
  for (unsigned bits = 0; bits < 32; ++bits) {
    const Flags flags = flags_of(bits);
    const SampleRange range = range_of(flags, 8);
    unsigned lane = 0;
    for (int32_t parent = range.lo; parent <= range.hi; ++parent) {
      for (int32_t r = -range.bound; r <= range.bound; ++r) {
        const int32_t other = random.in(-range.bound, range.bound);
        bench.put(lane, parent, flags.motion ? r : other, flags.motion ? other : r);
        lane = (lane + 1) % bench.kSamples;
        if (lane == 0) bench.check(flags, 8);
      }
    }
  }
  bench.finish();
  expect_equal(bench.counts, 2 * 16 * 2 * (256 * 511 + 511 * 1021 - 32));
}

// Depths 8 to 12 of a unit for depth 12; random and at the ends of the ranges.
TEST(Reconstruct, RandomAtEveryDepth) {
  Bench<Reconstruct3x12, 3, 12> bench;
  Random random(2);
  for (int depth = 8; depth <= 12; ++depth) {
    for (unsigned turn = 0; turn < 32 * 200; ++turn) {
      const Flags flags = flags_of(turn % 32);
      const SampleRange range = range_of(flags, depth);
      for (unsigned i = 0; i < bench.kSamples; ++i) {
        bench.put(i, random.often_extreme(range.lo, range.hi),
                  random.often_extreme(-range.bound, range.bound),
                  random.often_extreme(-range.bound, range.bound));
      }
      bench.check(flags, depth);
    }
  }
  bench.finish();
  expect_equal(bench.counts, 2 * 5 * 32 * 200 * 64 * 2);
}

}  // namespace
}  // namespace hmlfc::test
