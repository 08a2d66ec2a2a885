// The fast interpolation against its definition, sample by sample (MOT-9).
#include "decoder/fast/interpolate.hpp"

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "arithmetic/motion.hpp"

namespace hmlfc {
namespace {

constexpr int16_t kGuard = -32123;

int draw(std::mt19937& random, int lo, int hi) {
  return std::uniform_int_distribution(lo, hi)(random);
}

/// Exactly the samples that one reference needs, so that a memory checker sees any other read.
struct Source {
  std::vector<int16_t> samples;
  DisplacedReference reference;

  Source(std::mt19937& random, unsigned columns, unsigned rows, int32_t bound, int32_t fx,
         int32_t fy) {
    const size_t right = fx > 0 ? 1 : 0;
    const size_t below = fy > 0 ? 1 : 0;
    const size_t stride = columns + right + static_cast<size_t>(draw(random, 0, 3));
    samples.resize(stride * (rows + below - 1) + columns + right);
    const bool extreme = draw(random, 0, 1) != 0;
    for (int16_t& sample : samples) {
      const int32_t end = draw(random, 0, 1) != 0 ? bound : -bound;
      sample = static_cast<int16_t>(extreme ? end : draw(random, -bound, bound));
    }
    if (extreme && draw(random, 0, 2) == 0) {
      samples.assign(samples.size(),
                     static_cast<int16_t>(draw(random, 0, 1) != 0 ? bound : -bound));
    }
    reference = {{samples.data(), stride}, fx, fy};
  }

  int32_t sum(unsigned x, unsigned y) const {
    const size_t right = reference.fx > 0 ? 1 : 0;
    const size_t below = reference.fy > 0 ? reference.view.stride : 0;
    const int16_t* at = samples.data() + y * reference.view.stride + x;
    return weighted_sum(tap_weights(reference.fx, reference.fy),
                        {at[0], at[right], at[below], at[below + right]});
  }
};

void check(std::mt19937& random, unsigned columns, unsigned rows, int32_t bound, unsigned count,
           std::array<int32_t, 4> fractions) {
  const Source first(random, columns, rows, bound, fractions[0], fractions[1]);
  const Source second(random, columns, rows, bound, fractions[2], fractions[3]);
  const size_t stride = columns + static_cast<size_t>(draw(random, 0, 5));
  std::vector<int16_t> out(stride * rows, kGuard);
  interpolate_rect({first.reference, second.reference}, count, bound,
                   {out.data(), stride, columns, rows});
  for (unsigned y = 0; y < rows; ++y) {
    for (unsigned x = 0; x < columns; ++x) {
      const int32_t expected = count == 1 ? one_reference_value(first.sum(x, y))
                                          : two_reference_value(first.sum(x, y), second.sum(x, y));
      ASSERT_EQ(out[y * stride + x], expected)
          << x << ", " << y << " of " << columns << " x " << rows << ", bound " << bound << ", "
          << count << " references, fractions " << fractions[0] << " " << fractions[1] << " "
          << fractions[2] << " " << fractions[3];
    }
    for (size_t x = columns; x < stride; ++x) ASSERT_EQ(out[y * stride + x], kGuard);
  }
}

// Bounds on both sides of what 16 bits hold: 511 and 512 with one reference, 255 and 256 with two.
TEST(Interpolate, EveryFractionOfEachReference) {
  std::mt19937 random(1);
  for (const int32_t bound : {255, 256, 510, 511, 512, 4095, 8190}) {
    for (int32_t fractions = 0; fractions < 64; ++fractions) {
      const int32_t other = draw(random, 0, 63);
      const std::array<int32_t, 4> f{fractions % 8, fractions / 8, other % 8, other / 8};
      for (const unsigned columns : {2u, 4u, 8u, 20u}) {
        ASSERT_NO_FATAL_FAILURE(check(random, columns, 5, bound, 1, f));
        ASSERT_NO_FATAL_FAILURE(check(random, columns, 5, bound, 2, f));
        ASSERT_NO_FATAL_FAILURE(check(random, columns, 5, bound, 2, {f[2], f[3], f[0], f[1]}));
      }
    }
  }
}

TEST(Interpolate, EverySize) {
  std::mt19937 random(2);
  for (unsigned columns = 1; columns <= 33; ++columns) {
    for (const unsigned rows : {1u, 2u, 7u, 32u}) {
      for (const int32_t bound : {255, 8190}) {
        for (const unsigned count : {1u, 2u}) {
          const std::array<int32_t, 4> f{draw(random, 0, 7), draw(random, 0, 7), draw(random, 0, 7),
                                         draw(random, 0, 7)};
          ASSERT_NO_FATAL_FAILURE(check(random, columns, rows, bound, count, f));
          ASSERT_NO_FATAL_FAILURE(check(random, columns, rows, bound, count, {0, 0, 0, 0}));
        }
      }
    }
  }
}

}  // namespace
}  // namespace hmlfc
