// GEO-4 to GEO-6 against exact fractions.
#include "render/disparity_value.hpp"

#include <gtest/gtest.h>

#include "scenes/test_light_fields.hpp"

namespace hmlfc {
namespace {

__extension__ using Wide = __int128;

Wide size_of(Wide x) { return x < 0 ? -x : x; }

// Whether `d` is the integer nearest to over / under, ties away from 0, or the end of 16 bits that
// is nearest to it.
bool is_nearest(int32_t d, Wide over, Wide under) {
  const Wide twice = 2 * over;
  if (d == 32767) return twice >= (2 * Wide{d} - 1) * under;
  if (d == -32768) return twice <= (2 * Wide{d} + 1) * under;
  const Wide off = 2 * size_of(Wide{d} * under - over);
  if (off == under) return size_of(d) * under > size_of(over);
  return off < under;
}

TEST(DisparityValue, OfADisparityIsTheNearestOfAllUnits) {
  for (unsigned precision = 0; precision <= 5; ++precision) {
    for (int32_t d = -4096; d <= 4095; ++d) {
      for (const int32_t apart : {1, 2, 3, 64, 4096}) {
        const int16_t D = scaled_disparity(d, precision, apart);
        ASSERT_TRUE(is_nearest(D, Wide{d} * 256, Wide{apart} << precision))
            << d << " " << precision << " " << apart;
      }
    }
  }
}

TEST(DisparityValue, OfAVectorIsItsProjectionOnTheBaseline) {
  test::Random random(1);
  const auto number = [&](int32_t most) {
    const int32_t limit = random() % 3 == 0 ? 20 : most;
    return static_cast<int32_t>(random() % (2 * static_cast<uint32_t>(limit) + 1)) - limit;
  };
  int along = 0;
  for (int n = 0; n < 200'000; ++n) {
    const Span v{number(1016), number(1016)};
    const Span g{16 * number(4095), number(127 * 4095)};
    if (g.x == 0 && g.y == 0) continue;
    // In pixels and columns the vector is v / 8 and the baseline g / 16: the dot product over the
    // squared length, times 256.
    const Wide dot = Wide{v.x} * g.x + Wide{v.y} * g.y;
    const Wide length = Wide{g.x} * g.x + Wide{g.y} * g.y;
    ASSERT_TRUE(is_nearest(vector_disparity(v, g), dot * 256 * 16, length * 8))
        << v.x << "," << v.y << " along " << g.x << "," << g.y;
    // Pythagoras: what is left of v has the squared length v^2 - dot^2 / length, in eighths.
    const Wide left = (Wide{v.x} * v.x + Wide{v.y} * v.y) * length - dot * dot;
    ASSERT_EQ(is_along(v, g), left <= 16 * length);
    along += is_along(v, g) ? 1 : 0;
  }
  EXPECT_GT(along, 1000);
}

}  // namespace
}  // namespace hmlfc
