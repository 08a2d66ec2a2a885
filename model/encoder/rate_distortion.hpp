// The trade of squared error against bits, in integers.
#pragma once

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

/// About what a tile that is not empty takes in the index and by padding to whole bytes.
inline constexpr int64_t kTileOverheadBits = 15;

}  // namespace hmlfc
