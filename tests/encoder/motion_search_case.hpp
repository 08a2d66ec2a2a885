// Random searches to run both ways.
#pragma once

#include <algorithm>
#include <cstdint>
#include <ostream>
#include <random>
#include <span>
#include <vector>

#include "encoder/motion_search.hpp"

namespace hmlfc {

inline std::ostream& operator<<(std::ostream& out, const MotionMatch& match) {
  return out << (match.negative ? "-" : "+") << "(" << match.dx << ", " << match.dy << ") sad "
             << match.sad;
}

}  // namespace hmlfc

namespace hmlfc::test {

using Random = std::mt19937;
using Samples = std::vector<int16_t>;

inline int uniform(Random& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

/// A kind of plane: one sample at a time.
struct Kind {
  const char* name;
  int16_t (*sample)(Random&);
};

inline int16_t either(Random& random, int first, int second) {
  return static_cast<int16_t>(uniform(random, 0, 1) == 0 ? first : second);
}

inline constexpr Kind kKinds[] = {
    {"noise of 8 bits",
     [](Random& random) { return static_cast<int16_t>(uniform(random, -255, 255)); }},
    {"noise of 12 bits",
     [](Random& random) { return static_cast<int16_t>(uniform(random, -4095, 4095)); }},
    {"noise of 14 bits",
     [](Random& random) { return static_cast<int16_t>(uniform(random, -16382, 16382)); }},
    {"mostly zero",
     [](Random& random) {
       return static_cast<int16_t>(uniform(random, 0, 9) > 0 ? 0 : uniform(random, -40, 40));
     }},
    {"many ties", [](Random& random) { return either(random, -1, 1); }},
    {"extremes", [](Random& random) { return either(random, -16382, 16382); }},
    {"flat", [](Random&) { return int16_t{7}; }},
};

/// One search, both ways.
struct Search {
  const ReferencePlane& reference;
  Samples block;
  int size;
  uint32_t x;
  uint32_t y;
  int window;
  bool both_signs;

  MotionMatch expected() const {
    return search_motion_brute_force(block, size, x, y, reference, window, both_signs);
  }
  MotionMatch actual(std::span<const MotionMatch> hints = {}) const {
    return search_motion(block, size, x, y, reference, window, both_signs, hints);
  }
};

inline std::ostream& operator<<(std::ostream& out, const Search& search) {
  return out << search.size << "x" << search.size << " at " << search.x << "," << search.y << " in "
             << search.reference.width() << "x" << search.reference.height() << " window "
             << search.window << (search.both_signs ? " both signs" : "");
}

inline Samples draw(Random& random, const Kind& kind, size_t count) {
  Samples samples(count);
  std::generate(samples.begin(), samples.end(), [&] { return kind.sample(random); });
  return samples;
}

/// A block that the reference holds, negated or not, where the window reaches it; or a fresh one.
inline Samples some_block(Random& random, const Kind& kind, const ReferencePlane& reference,
                          int size, uint32_t x, uint32_t y, int window) {
  Samples block = draw(random, kind, static_cast<size_t>(size * size));
  const int choice = uniform(random, 0, 3);
  const int dx = uniform(random, -window, window);
  const int dy = uniform(random, -window, window);
  for (int k = 0; choice < 2 && k < size * size; ++k) {
    const int sample = *reference.sample(int64_t{x} + dx + k % size, int64_t{y} + dy + k / size);
    block[static_cast<size_t>(k)] = static_cast<int16_t>(choice == 0 ? sample : -sample);
  }
  return block;
}

}  // namespace hmlfc::test
