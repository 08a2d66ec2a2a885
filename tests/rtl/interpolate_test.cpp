// hmlfc_interpolate against the model (MOT-9).
#include <vector>

#include <Interpolate1x10.h>
#include <Interpolate2x10.h>
#include <Interpolate3x14.h>

#include "arithmetic/motion.hpp"
#include "rtl/ports.hpp"

namespace hmlfc::test {
namespace {

// I(x, y) of the reference in `window`.
template <class Port>
int32_t sum_at(const Port& window, unsigned side, unsigned bits, unsigned x, unsigned y, int fx,
               int fy) {
  const auto sample = [&](unsigned i, unsigned j) {
    return get_signed(window, size_t{bits} * (j * side + i), bits);
  };
  return weighted_sum(tap_weights(fx, fy),
                      {sample(x, y), sample(x + 1, y), sample(x, y + 1), sample(x + 1, y + 1)});
}

// Random samples, samples at the ends of their range, and blocks all at one end.
template <class Port>
void fill_window(Port& window, unsigned samples, unsigned bits, Random& random) {
  const int32_t least = -(1 << (bits - 1));
  const int kind = random.in(0, 3);
  const int32_t fixed = random.often_extreme(least, -least - 1);
  for (unsigned i = 0; i < samples; ++i) {
    const int32_t value = kind == 0   ? random.in(least, -least - 1)
                          : kind == 1 ? random.in(-8, 8)
                          : kind == 2 ? random.often_extreme(least, -least - 1)
                                      : fixed;
    put_bits(window, size_t{bits} * i, bits, value);
  }
}

// Every pair of fractions of both references, with one reference and with two.
template <class Dut, unsigned kBlockLog2, unsigned kBits>
Counts interpolate_all() {
  constexpr unsigned kBlock = 1u << kBlockLog2;
  constexpr unsigned kSide = kBlock + 1;
  Dut dut;
  Random random(kBlockLog2 + kBits);
  Counts counts;
  Pipeline<Dut, std::vector<int32_t>> pipeline(dut, 3, random);
  for (unsigned fractions = 0; fractions < 8192; ++fractions) {
    const int fx_a = fractions & 7, fy_a = (fractions >> 3) & 7;
    const int fx_b = (fractions >> 6) & 7, fy_b = (fractions >> 9) & 7;
    const bool two = fractions >= 4096;
    fill_window(dut.window_a, kSide * kSide, kBits, random);
    fill_window(dut.window_b, kSide * kSide, kBits, random);
    dut.fx_a = static_cast<uint8_t>(fx_a);
    dut.fy_a = static_cast<uint8_t>(fy_a);
    dut.fx_b = static_cast<uint8_t>(fx_b);
    dut.fy_b = static_cast<uint8_t>(fy_b);
    dut.two = two;
    std::vector<int32_t> expected;
    for (unsigned y = 0; y < kBlock; ++y) {
      for (unsigned x = 0; x < kBlock; ++x) {
        const int32_t first = sum_at(dut.window_a, kSide, kBits, x, y, fx_a, fy_a);
        const int32_t second = sum_at(dut.window_b, kSide, kBits, x, y, fx_b, fy_b);
        expected.push_back(two ? two_reference_value(first, second) : one_reference_value(first));
      }
    }
    pipeline.step(std::move(expected), [&](const std::vector<int32_t>& prediction) {
      for (unsigned i = 0; i < kBlock * kBlock; ++i) {
        counts.compare(get_signed(dut.prediction, size_t{kBits} * i, kBits), prediction[i]);
      }
    });
  }
  return counts;
}

TEST(Interpolate, BlocksOf2) { expect_equal((interpolate_all<Interpolate1x10, 1, 10>()), 32000); }
TEST(Interpolate, BlocksOf4) { expect_equal((interpolate_all<Interpolate2x10, 2, 10>()), 131000); }
TEST(Interpolate, BlocksOf8OfDepth12) {
  expect_equal((interpolate_all<Interpolate3x14, 3, 14>()), 524000);
}

}  // namespace
}  // namespace hmlfc::test
