// The definition of the motion search, against an even plainer one and against cases worked by
// hand.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "encoder/motion_search.hpp"

namespace hmlfc {
namespace {

/// A plane without any preparation.
struct DensePlane {
  int width;
  int height;
  std::vector<int16_t> samples;

  int at(int x, int y) const {
    const int col = std::clamp(x, 0, width - 1);
    const int row = std::clamp(y, 0, height - 1);
    return samples[static_cast<size_t>(row * width + col)];
  }
};

/// All candidates, sorted; the first is the match.
MotionMatch first_of_all(const std::vector<int16_t>& block, int size, int x, int y,
                         const DensePlane& plane, int window, bool both_signs) {
  using Key = std::tuple<int, bool, int, int, int>;  // in the order of the tie rule
  std::vector<Key> candidates;
  for (int sign : {1, -1}) {
    for (int dx = -window; dx <= window; ++dx) {
      for (int dy = -window; dy <= window; ++dy) {
        int sad = 0;
        for (int k = 0; k < size * size; ++k) {
          const int reference = plane.at(x + dx + k % size, y + dy + k / size);
          sad += std::abs(block[static_cast<size_t>(k)] - sign * reference);
        }
        if (sign == 1 || both_signs) {
          candidates.emplace_back(sad, sign < 0, std::abs(dx) + std::abs(dy), dy, dx);
        }
      }
    }
  }
  std::sort(candidates.begin(), candidates.end());
  const auto& [sad, negative, length, dy, dx] = candidates.front();
  return {static_cast<int16_t>(dx), static_cast<int16_t>(dy), negative, static_cast<uint32_t>(sad)};
}

MotionMatch brute_force(const std::vector<int16_t>& block, int size, int x, int y,
                        const DensePlane& plane, int window, bool both_signs) {
  const ReferencePlane reference(plane.samples, static_cast<uint32_t>(plane.width),
                                 static_cast<uint32_t>(plane.height), window);
  return search_motion_brute_force(block, size, static_cast<uint32_t>(x), static_cast<uint32_t>(y),
                                   reference, window, both_signs);
}

TEST(MotionSearchDefinition, IsTheFirstOfAllSortedCandidates) {
  std::mt19937 random(1);
  const auto uniform = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  for (int round = 0; round < 400; ++round) {
    DensePlane plane{uniform(1, 12), uniform(1, 12), {}};
    const int amplitude = std::array{1, 2, 300, 16382}[static_cast<size_t>(round % 4)];
    const auto sample = [&] { return static_cast<int16_t>(uniform(-amplitude, amplitude)); };
    plane.samples.resize(static_cast<size_t>(plane.width * plane.height));
    std::generate(plane.samples.begin(), plane.samples.end(), sample);
    const int size = 1 << uniform(1, 3);
    std::vector<int16_t> block(static_cast<size_t>(size * size));
    std::generate(block.begin(), block.end(), sample);
    const int x = uniform(0, plane.width - 1);
    const int y = uniform(0, plane.height - 1);
    const int window = uniform(0, 7);
    for (const bool both_signs : {false, true}) {
      ASSERT_EQ(brute_force(block, size, x, y, plane, window, both_signs),
                first_of_all(block, size, x, y, plane, window, both_signs))
          << "round " << round << " both signs " << both_signs;
    }
  }
}

/// A 9x9 plane of zeros with single samples set; blocks are 2x2 at (4, 4), the window is 3.
MotionMatch match_of(const std::vector<int16_t>& block,
                     const std::vector<std::tuple<int, int, int16_t>>& set, bool both_signs) {
  DensePlane plane{9, 9, std::vector<int16_t>(81)};
  for (const auto& [x, y, value] : set) {
    plane.samples[static_cast<size_t>(y * 9 + x)] = value;
  }
  return brute_force(block, 2, 4, 4, plane, 3, both_signs);
}

TEST(MotionSearchDefinition, ByHand) {
  struct Case {
    const char* what;
    std::vector<std::tuple<int, int, int16_t>> set;
    bool both_signs;
    MotionMatch match;
  };
  for (const Case& c : {
           Case{"the block where it is", {{6, 3, 50}}, false, {2, -1, false, 0}},
           Case{"negated on request", {{6, 3, -50}}, true, {2, -1, true, 0}},
           Case{"not negated without", {{6, 3, -50}}, false, {0, 0, false, 50}},
           Case{"sad precedes sign and length", {{4, 4, 48}, {7, 7, -49}}, true, {3, 3, true, 1}},
           Case{"sign precedes length", {{4, 4, -50}, {7, 7, 50}}, true, {3, 3, false, 0}},
           Case{"length precedes dy and dx", {{2, 2, 50}, {7, 4, 50}}, true, {3, 0, false, 0}},
           Case{"smaller dy precedes smaller dx",
                {{1, 4, 50}, {7, 4, 50}, {4, 1, 50}, {4, 7, 50}},
                true,
                {0, -3, false, 0}},
           Case{"smaller dx is the last rule", {{2, 4, 50}, {6, 4, 50}}, true, {-2, 0, false, 0}},
           Case{"a flat reference gives the zero vector", {}, true, {0, 0, false, 50}},
           Case{"the window is inclusive", {{1, 1, 50}}, false, {-3, -3, false, 0}},
           Case{"at both ends", {{7, 7, 50}}, false, {3, 3, false, 0}},
       }) {
    EXPECT_EQ(match_of({50, 0, 0, 0}, c.set, c.both_signs), c.match) << c.what;
  }
}

TEST(MotionSearchDefinition, LargestSad) {
  const DensePlane plane{1, 1, {-16382}};
  const std::vector<int16_t> block(64, 16382);
  EXPECT_EQ(brute_force(block, 8, 0, 0, plane, 1, false),
            (MotionMatch{0, 0, false, 64 * 2 * 16382}));
  EXPECT_EQ(brute_force(block, 8, 0, 0, plane, 1, true), (MotionMatch{0, 0, true, 0}));
}

TEST(MotionSearchDefinition, PrecedesIsATotalOrder) {
  std::vector<MotionMatch> all;
  for (uint32_t sad : {0U, 5U}) {
    for (const bool negative : {false, true}) {
      for (int16_t dy = -2; dy <= 2; ++dy) {
        for (int16_t dx = -2; dx <= 2; ++dx) {
          all.push_back({dx, dy, negative, sad});
        }
      }
    }
  }
  for (const MotionMatch& a : all) {
    EXPECT_FALSE(precedes(a, a));
    for (const MotionMatch& b : all) {
      EXPECT_TRUE(a == b || precedes(a, b) != precedes(b, a));
      for (const MotionMatch& c : all) {
        ASSERT_TRUE(!precedes(a, b) || !precedes(b, c) || precedes(a, c));
      }
    }
  }
}

}  // namespace
}  // namespace hmlfc
