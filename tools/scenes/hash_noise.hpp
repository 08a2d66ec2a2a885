// The scenes' only source of randomness: an integer hash, the same everywhere.
#pragma once

#include <cstdint>

namespace hmlfc::scenes {

/// A bijective mix of 64 bits (the output function of SplitMix64).
constexpr uint64_t mix_bits(uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

/// The top 53 bits of a hash as a number in [0, 1).
constexpr double unit_interval(uint64_t hash) {
  return static_cast<double>(hash >> 11) * (1.0 / 9007199254740992.0);
}

/// A stream of random numbers for one purpose, identified by `key`. Do not draw twice in the
/// arguments of one call: compilers evaluate them in different orders. (Braces keep their order.)
class HashStream {
 public:
  constexpr HashStream(uint64_t seed, uint64_t key) : state_(mix_bits(mix_bits(seed) ^ key)) {}

  constexpr uint64_t next() { return mix_bits(state_++); }
  /// Uniform in [low, high).
  constexpr double uniform(double low, double high) {
    return low + (high - low) * unit_interval(next());
  }
  /// Uniform in [0, count - 1]; count in [1, 2^32].
  constexpr uint32_t below(uint64_t count) {
    return static_cast<uint32_t>((next() >> 32) * count >> 32);
  }

 private:
  uint64_t state_;
};

/// floor(x); |x| < 2^62.
constexpr int64_t floor_to_int(double x) {
  const auto truncated = static_cast<int64_t>(x);
  return truncated - (x < static_cast<double>(truncated) ? 1 : 0);
}

/// x minus its floor, in [0, 1).
constexpr double fraction(double x) { return x - static_cast<double>(floor_to_int(x)); }

/// A random number in [0, 1) for a cell of the integer grid.
constexpr double cell_noise(uint64_t seed, int64_t x, int64_t y) {
  const uint64_t cell = static_cast<uint64_t>(x) * 0x9E3779B97F4A7C15u ^
                        static_cast<uint64_t>(y) * 0xC2B2AE3D27D4EB4Fu;
  return unit_interval(mix_bits(cell ^ seed));
}

/// Smooth value noise of period about 1 in each direction, in [0, 1].
double value_noise(uint64_t seed, double x, double y);

/// `octaves` layers of value noise, each with half the period and half the weight of the one
/// before; in [0, 1].
double layered_noise(uint64_t seed, double x, double y, int octaves);

}  // namespace hmlfc::scenes
