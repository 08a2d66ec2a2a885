// hmlfc_vector against the model (MOT-8, MOT-9).
#include <array>

#include <Vector.h>

#include "arithmetic/motion.hpp"
#include "rtl/ports.hpp"

namespace hmlfc::test {
namespace {

class Bench {
 public:
  void precisions(unsigned vector_precision, unsigned disparity_precision, int window) {
    vector_precision_ = vector_precision;
    dut_.vector_precision = static_cast<uint8_t>(vector_precision);
    dut_.disparity_precision = static_cast<uint8_t>(disparity_precision);
    dut_.window = static_cast<uint8_t>(window);
    rules_.bound = window << vector_precision;
    rules_.shift = disparity_precision - vector_precision;
  }

  void check_disparity(int32_t d, int row_offset, int col_offset, int row_scale, bool halve) {
    rules_.row_scale = row_scale;
    put_bits(dut_.disparity, 0, 13, d);
    put_bits(dut_.coefficient_x, 0, 10, col_offset);
    put_bits(dut_.coefficient_y, 0, 18, row_scale * row_offset);
    dut_.explicit_mode = 0;
    // Does not matter, so it is never the same.
    put_bits(dut_.explicit_x, 0, 12, random_.in(0, 4095));
    check(disparity_vector(d, row_offset, col_offset, rules_), halve);
  }

  void check_explicit(int32_t x, int32_t y, bool halve) {
    put_bits(dut_.explicit_x, 0, 12, x);
    put_bits(dut_.explicit_y, 0, 12, y);
    dut_.explicit_mode = 1;
    put_bits(dut_.disparity, 0, 13, random_.in(0, 8191));
    check(explicit_vector(x, y, rules_), halve);
  }

  Counts counts;
  Random& random() { return random_; }

 private:
  Vector dut_;
  Random random_{9};
  Pipeline<Vector, SubpelVector> pipeline_{dut_, 6, random_};
  VectorRules rules_;
  unsigned vector_precision_ = 0;

  void check(const MotionVector& v, bool halve) {
    dut_.halve = halve;
    pipeline_.step(subpel_vector(v, vector_precision_, halve), [&](const SubpelVector& s) {
      counts.compare(get_signed(dut_.ix, 0, 9), s.ix);
      counts.compare(get_signed(dut_.iy, 0, 9), s.iy);
      counts.compare(dut_.fx, s.fx);
      counts.compare(dut_.fy, s.fy);
    });
  }
};

// Every disparity with every pair of precisions, for offsets to the ends of their intervals.
TEST(Vector, EveryDisparity) {
  constexpr std::array<std::array<int, 3>, 8> kOffsets{{{1, 1, 16},
                                                        {-1, -1, 16},
                                                        {-3, 2, 7},
                                                        {382, 382, 127},
                                                        {-382, -382, 127},
                                                        {-1023, 511, -127},
                                                        {0, 0, 127},
                                                        {1, -2, -1}}};
  Bench bench;
  for (unsigned vector_precision = 0; vector_precision <= 3; ++vector_precision) {
    for (unsigned precision = vector_precision; precision <= 5; ++precision) {
      for (const auto& [row_offset, col_offset, row_scale] : kOffsets) {
        for (int32_t d = kMinDisparity; d <= kMaxDisparity; ++d) {
          bench.precisions(vector_precision, precision, bench.random().often_extreme(0, 127));
          bench.check_disparity(d, row_offset, col_offset, row_scale, bench.random().one_in(2));
        }
      }
    }
  }
  expect_equal(bench.counts, 18 * 8 * 8192 * 4 - 4);
}

TEST(Vector, EveryExplicitVector) {
  Bench bench;
  for (unsigned vector_precision = 0; vector_precision <= 3; ++vector_precision) {
    for (const int window : {0, 1, 16, 127}) {
      bench.precisions(vector_precision, 5, window);
      for (int32_t x = -2048; x <= 2047; ++x) {
        bench.check_explicit(x, -1 - x, false);
        bench.check_explicit(x, bench.random().in(-2048, 2047), true);
      }
    }
  }
  expect_equal(bench.counts, 4 * 4 * 4096 * 2 * 4 - 4);
}

}  // namespace
}  // namespace hmlfc::test
