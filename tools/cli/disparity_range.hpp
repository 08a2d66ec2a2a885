// Which disparities a stream has.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <hmlfc/disparity.hpp>

#include "cli/view_source.hpp"

namespace hmlfc::cli {

/// The disparities of blocks that have one, in their units.
struct DisparityRange {
  int32_t least = 0;
  int32_t greatest = 0;
  uint64_t known = 0;   ///< blocks with a confidence above 0
  uint64_t blocks = 0;  ///< all

  void add(const DisparityMap& map);
  void add(const DisparityRange& other);
};

/// That of all views of `file`; nothing where a header asks for far more views and blocks than the
/// bytes of the file can fill: the time follows these. Failure (kCorrupt) as for decoding.
std::optional<DisparityRange> disparity_range(const StreamFile& file);

/// "disparity -1.31 to 2.84 pixels a column, known for 97.5 % of the blocks", "disparity unknown"
/// or, of nothing, "disparity not counted".
std::string describe(const std::optional<DisparityRange>& range);

}  // namespace hmlfc::cli
