// The trade of squared error against bits, in integers.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace hmlfc {

/// The squared error that one bit is worth, in 256ths: integers, so that every machine decides
/// alike.
struct Lambda {
  int64_t scaled = 0;  ///< [0, 2^40]

  /// D + lambda * R in 256ths of squared error.
  constexpr int64_t cost(int64_t squared_error, int64_t bits) const {
    return squared_error * 256 + scaled * bits;
  }
};

/// 256 * log2(x) for x >= 1, linear between powers of two: at most 22 too low.
constexpr int64_t log2_in_256ths(int64_t x) {
  const auto whole = static_cast<int64_t>(std::bit_width(static_cast<uint64_t>(x))) - 1;
  const int64_t beyond = x - (int64_t{1} << whole);
  return 256 * whole + (whole >= 8 ? beyond >> (whole - 8) : beyond << (8 - whole));
}

/// Estimates what motion leaves of a block of 4x4 samples, as D + lambda R in units of squared
/// error, shrunk by `shift` bits, once its residual is coded where that pays. With a step of
/// sqrt(10 lambda), as steps are chosen, a residual pays from about 41 lambda on; then each
/// doubling of the energy takes half a bit a sample.
class ResidualEstimate {
 public:
  explicit constexpr ResidualEstimate(Lambda lambda, unsigned shift = 0)
      : shift_(shift),
        least_(std::max<int64_t>(1, 41 * lambda.scaled >> 8)),
        log_least_(log2_in_256ths(least_)),
        lambda_(lambda) {}

  /// `energy`: the sum of the block's squared errors.
  constexpr int64_t operator()(int64_t energy) const {
    if (energy <= least_) return energy >> shift_;
    const int64_t bits = 8 * lambda_.scaled * (log2_in_256ths(energy) - log_least_);
    return (least_ + (bits >> 16)) >> shift_;
  }

  /// The derivative of the estimate at `energy`: `whole`, in [1, 1000], while the energy counts as
  /// it is, then whole * 8 lambda / (ln 2 * energy), rounded down.
  constexpr int64_t slope(int64_t energy, int64_t whole) const {
    if (energy <= least_) return whole;
    return whole * 1154 * lambda_.scaled / (25600 * energy);
  }

 private:
  unsigned shift_;
  int64_t least_;
  int64_t log_least_;
  Lambda lambda_;
};

/// Bits by which estimates of motion shrink, so that those of a tile add up to less than 2^30: none
/// for samples of 8 bits.
constexpr unsigned shift_of(Lambda lambda) {
  constexpr int64_t kLargest = 1'500'000;  // 256 * 2^12.5 is the one of quality 0
  return static_cast<unsigned>(std::bit_width(static_cast<uint64_t>(lambda.scaled / kLargest)));
}

/// About what a tile that is not empty takes in the index and by padding to whole bytes.
inline constexpr int64_t kTileOverheadBits = 15;

}  // namespace hmlfc
