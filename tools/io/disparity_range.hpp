// Which disparities a stream has.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <hmlfc/disparity.hpp>

namespace hmlfc::io {

/// The disparities of blocks that have one, in their units.
struct DisparityRange {
  int32_t least = 0;
  int32_t greatest = 0;
  uint64_t known = 0;   ///< blocks with a confidence above 0
  uint64_t blocks = 0;  ///< all

  void add(const DisparityMap& map);
  void add(const DisparityRange& other);
};

/// That of all views of a stream of `bytes` bytes; nothing where a header asks for far more views
/// and blocks than these can fill: the time follows them. Errors as for decoding.
Result<std::optional<DisparityRange>> disparity_range(const Decoder& decoder, uint64_t bytes);

/// "disparity -1.31 to 2.84 pixels a column, known for 97.5 % of the blocks", "disparity unknown"
/// or, of nothing, "disparity not counted".
std::string describe(const std::optional<DisparityRange>& range);

}  // namespace hmlfc::io
