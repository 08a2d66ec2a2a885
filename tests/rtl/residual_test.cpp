// hmlfc_residual against the model (TIL-10, STP-3).
#include <vector>

#include <Residual1x12.h>
#include <Residual2x8.h>

#include "arithmetic/bise.hpp"
#include "arithmetic/reconstruct.hpp"
#include "rtl/ports.hpp"

namespace hmlfc::test {
namespace {

template <class Dut, unsigned kBlockLog2, int kMaxDepth>
class Bench {
 public:
  static constexpr unsigned kSamples = 1u << (2 * kBlockLog2);
  static constexpr unsigned kBits = kMaxDepth + 2;

  /// A block of `values`, which must be below the level count.
  void check(const std::vector<uint32_t>& values, unsigned code, int32_t bias, unsigned step,
             bool chroma, int depth) {
    std::vector<int32_t> expected;
    const SampleRange range = sample_range(chroma ? Plane::kCg : Plane::kY, depth);
    for (unsigned i = 0; i < kSamples; ++i) {
      put_bits(dut_.values, size_t{kBits} * i, kBits, values[i]);
      expected.push_back(
          stepped_residual(values[i], levels_of_code(code).count, bias, step_of_code(step), range));
    }
    dut_.level_code = static_cast<uint8_t>(code);
    put_bits(dut_.bias, 0, kBits, bias);
    dut_.step_code = static_cast<uint8_t>(step);
    dut_.chroma = chroma;
    dut_.depth = static_cast<uint8_t>(depth);
    pipeline_.step(std::move(expected), [&](const std::vector<int32_t>& residuals) {
      for (unsigned i = 0; i < kSamples; ++i) {
        counts.compare(get_signed(dut_.residuals, size_t{kBits} * i, kBits), residuals[i]);
      }
    });
  }

  Counts counts;

 private:
  Dut dut_;
  Random random_{3};
  Pipeline<Dut, std::vector<int32_t>> pipeline_{dut_, 4, random_};
};

// Every value of every level code with every step, for the ends of the bias and biases between.
TEST(Residual, EveryValueAtDepth8) {
  Bench<Residual2x8, 2, 8> bench;
  Random random(4);
  std::vector<uint32_t> values(bench.kSamples);
  for (unsigned code = 0; code <= max_residual_level_code(8); ++code) {
    const uint32_t count = levels_of_code(code).count;
    for (unsigned step = 0; step <= kMaxStepCode; ++step) {
      for (const int32_t bias : {-512, -1, 0, 511, random.in(-512, 511)}) {
        for (uint32_t first = 0; first < count; first += bench.kSamples) {
          for (unsigned i = 0; i < bench.kSamples; ++i) values[i] = (first + i) % count;
          bench.check(values, code, bias, step, false, 8);
          bench.check(values, code, bias, step, true, 8);
        }
      }
    }
  }
  expect_equal(bench.counts, 28 * 16 * 5 * 2 * 16);
}

TEST(Residual, RandomAtEveryDepth) {
  Bench<Residual1x12, 1, 12> bench;
  Random random(5);
  std::vector<uint32_t> values(bench.kSamples);
  for (int depth = 8; depth <= 12; ++depth) {
    for (unsigned turn = 0; turn < 20000; ++turn) {
      const auto last = static_cast<int32_t>(max_residual_level_code(depth));
      const auto code = static_cast<unsigned>(random.often_extreme(0, last));
      const auto top = static_cast<int32_t>(levels_of_code(code).count) - 1;
      for (auto& value : values) value = static_cast<uint32_t>(random.often_extreme(0, top));
      const int32_t most = 1 << (depth + 1);
      bench.check(values, code, random.often_extreme(-most, most - 1),
                  static_cast<unsigned>(random.in(0, 15)), random.one_in(2), depth);
    }
  }
  expect_equal(bench.counts, 5 * 20000 * 4 - 4);
}

}  // namespace
}  // namespace hmlfc::test
