// The fast search finds what the definition finds: on every instruction set this machine has.
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "encoder/motion_search.hpp"
#include "encoder/motion_search_case.hpp"
#include "support/instruction_sets.hpp"

namespace hmlfc {
namespace {

using namespace test;

struct Plane {
  uint32_t width;
  uint32_t height;
};

constexpr Plane kPlanes[] = {{1, 1}, {3, 2}, {2, 40}, {50, 5}, {61, 47}};

/// Each test runs once for each instruction set.
class MotionSearch : public testing::TestWithParam<int64_t> {
 protected:
  const ChosenInstructionSet chosen_{GetParam()};

  /// Compares at the four corners, the four borders and inside, for one window and all else.
  void compare_everywhere(int window) {
    Random random(static_cast<Random::result_type>(window));
    for (const Kind& kind : kKinds) {
      for (const Plane& plane : kPlanes) {
        const Samples samples = draw(random, kind, size_t{plane.width} * plane.height);
        const ReferencePlane reference(samples, plane.width, plane.height, window);
        for (const uint32_t x : {0U, plane.width / 2, plane.width - 1}) {
          for (const uint32_t y : {0U, plane.height / 2, plane.height - 1}) {
            // Large windows are searched at some places only, since the definition is slow.
            if (window <= 16 || uniform(random, 0, window) < 8) {
              compare_sizes(random, kind, reference, x, y, window);
            }
          }
        }
      }
    }
  }

  static void compare_sizes(Random& random, const Kind& kind, const ReferencePlane& reference,
                            uint32_t x, uint32_t y, int window) {
    for (const int size : {2, 4, 8}) {
      for (const bool both_signs : {false, true}) {
        const Search search{
            reference, some_block(random, kind, reference, size, x, y, window), size, x, y, window,
            both_signs};
        ASSERT_EQ(search.actual(), search.expected()) << kind.name << ", " << search;
      }
    }
  }
};

TEST_P(MotionSearch, EveryWindow) {
  for (const int window : {0, 1, 2, 7, 8, 15, 16, 33, 127}) compare_everywhere(window);
}

TEST_P(MotionSearch, MatchesOnTheRimOfTheWindow) {
  for (const int window : {1, 7, 8, 15, 16, 17, 127}) {
    const uint32_t side = static_cast<uint32_t>(2 * window + 8);
    const Samples zeros(size_t{side} * side);
    for (const int dx : {-window, window - 1, window}) {
      for (const int dy : {-window, 0, window}) {
        // The only sample that is not 0 lies where the vector (dx, dy) takes the block's first one.
        Samples samples = zeros;
        samples[static_cast<size_t>(window + dy) * side + static_cast<size_t>(window + dx)] = -90;
        const ReferencePlane reference(samples, side, side, window);
        Samples block(16);
        block[0] = 90;
        const uint32_t at = static_cast<uint32_t>(window);
        const Search search{reference, block, 4, at, at, window, true};
        EXPECT_EQ(search.actual(),
                  (MotionMatch{static_cast<int16_t>(dx), static_cast<int16_t>(dy), true, 0}))
            << search;
      }
    }
  }
}

TEST_P(MotionSearch, SadsAroundTheLimitOf16Bits) {
  // A flat reference of 0: the sad is the sum of the block, wherever.
  const Samples zeros(30 * 30);
  const ReferencePlane reference(zeros, 30, 30, 16);
  for (const int size : {4, 8}) {
    for (int sad = 65520; sad <= 65550; ++sad) {
      const int count = size * size;
      Samples block(static_cast<size_t>(count), static_cast<int16_t>(sad / count));
      block[3] = static_cast<int16_t>(sad / count + sad % count);
      const Search search{reference, block, size, 11, 9, 16, true};
      ASSERT_EQ(search.actual(), (MotionMatch{0, 0, false, static_cast<uint32_t>(sad)})) << search;
    }
  }
}

TEST_P(MotionSearch, SumsThatLeave16Bits) {
  Random random(6);
  constexpr int kMagnitudes[] = {0, 1, 4096, 8191, 8192, 12287, 16382};
  for (const int block_magnitude : kMagnitudes) {
    for (const int reference_magnitude : kMagnitudes) {
      Samples samples(40 * 40);
      for (int16_t& sample : samples) {
        // Mostly one sign: whole squares of it.
        const bool negative = uniform(random, 0, 30) == 0;
        sample = static_cast<int16_t>(negative ? -reference_magnitude : reference_magnitude);
      }
      const ReferencePlane reference(samples, 40, 40, 16);
      for (const int sign : {-1, 1}) {
        for (const int size : {2, 4, 8}) {
          const Samples block(static_cast<size_t>(size * size),
                              static_cast<int16_t>(sign * block_magnitude));
          const Search search{reference, block, size, 17, 20, 16, true};
          ASSERT_EQ(search.actual(), search.expected())
              << search << " magnitudes " << block_magnitude << " and " << reference_magnitude;
        }
      }
    }
  }
}

TEST_P(MotionSearch, HintsChangeNothing) {
  Random random(7);
  for (const Kind& kind : kKinds) {
    const ReferencePlane reference(draw(random, kind, 50 * 50), 50, 50, 20);
    for (int round = 0; round < 20; ++round) {
      const int window = uniform(random, 0, 20);
      const uint32_t x = static_cast<uint32_t>(uniform(random, 0, 49));
      const uint32_t y = static_cast<uint32_t>(uniform(random, 0, 49));
      const Search search{
          reference, some_block(random, kind, reference, 4, x, y, window), 4, x, y, window, true};
      const MotionMatch expected = search.expected();
      MotionMatch lying = expected;
      lying.sad = 0;
      lying.negative = !expected.negative;
      const std::vector<std::vector<MotionMatch>> hint_lists{
          {},
          {expected},
          {lying},
          {{32767, 32767, false, 0}, {-32768, -32768, true, 0}, {21, 0, false, 0}, {0, -21}},
          std::vector<MotionMatch>(
              100, MotionMatch{static_cast<int16_t>(uniform(random, -20, 20)),
                               static_cast<int16_t>(uniform(random, -20, 20)), true, 1})};
      for (const std::vector<MotionMatch>& hints : hint_lists) {
        ASSERT_EQ(search.actual(hints), expected) << kind.name << ", " << search;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(On, MotionSearch, testing::ValuesIn(instruction_sets()),
                         [](const auto& target) { return instruction_set_name(target.param); });

}  // namespace
}  // namespace hmlfc
