// hmlfc_colour against the model (COL-2).
#include <vector>

#include <Colour1x8.h>
#include <Colour2x12.h>

#include "arithmetic/colour.hpp"
#include "arithmetic/widths.hpp"
#include "rtl/ports.hpp"

namespace hmlfc::test {
namespace {

template <class Dut, unsigned kBlockLog2, int kMaxDepth>
class Bench {
 public:
  static constexpr unsigned kSamples = 1u << (2 * kBlockLog2);

  void put(unsigned i, const YCoCg& p) {
    put_bits(dut_.y, (kMaxDepth + 1) * i, kMaxDepth + 1, p.y);
    put_bits(dut_.co, (kMaxDepth + 1) * i, kMaxDepth + 1, p.co);
    put_bits(dut_.cg, (kMaxDepth + 1) * i, kMaxDepth + 1, p.cg);
    pixels_[i] = p;
  }

  void check(int depth) {
    dut_.depth = static_cast<uint8_t>(depth);
    std::vector<Rgb> expected;
    for (const YCoCg& p : pixels_) expected.push_back(inverse_colour(p, depth));
    pipeline_.step(std::move(expected), [&](const std::vector<Rgb>& pixels) {
      for (unsigned i = 0; i < kSamples; ++i) {
        counts.compare(get_bits(dut_.lanes, 16 * i, 16), pixels[i].r);
        counts.compare(get_bits(dut_.lanes, 16 * (kSamples + i), 16), pixels[i].g);
        counts.compare(get_bits(dut_.lanes, 16 * (2 * kSamples + i), 16), pixels[i].b);
      }
    });
  }

  Counts counts;

 private:
  Dut dut_;
  Random random_{6};
  Pipeline<Dut, std::vector<Rgb>> pipeline_{dut_, 2, random_};
  std::vector<YCoCg> pixels_{kSamples};
};

// Every Co with every Cg, with Y at its ends and between.
TEST(Colour, EveryChromaAtDepth8) {
  Bench<Colour1x8, 1, 8> bench;
  Random random(7);
  for (int32_t co = -255; co <= 255; ++co) {
    for (int32_t cg = -255; cg <= 255; ++cg) {
      bench.put(0, {0, co, cg});
      bench.put(1, {255, co, cg});
      bench.put(2, {random.in(0, 255), co, cg});
      bench.put(3, {random.in(0, 255), co, cg});
      bench.check(8);
    }
  }
  expect_equal(bench.counts, 511 * 511 * 12);
}

TEST(Colour, RandomAtEveryDepth) {
  Bench<Colour2x12, 2, 12> bench;
  Random random(8);
  for (int depth = 8; depth <= 12; ++depth) {
    const int32_t hi = sample_range(Plane::kY, depth).hi;
    for (unsigned turn = 0; turn < 5000; ++turn) {
      for (unsigned i = 0; i < bench.kSamples; ++i) {
        bench.put(i, {random.often_extreme(0, hi), random.often_extreme(-hi, hi),
                      random.often_extreme(-hi, hi)});
      }
      bench.check(depth);
    }
  }
  expect_equal(bench.counts, 5 * 5000 * 48);
}

}  // namespace
}  // namespace hmlfc::test
