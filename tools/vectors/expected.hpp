// What the golden model says about a stream: pictures, checksums of blocks, errors.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <hmlfc/decoder.hpp>

namespace hmlfc::vectors {

/// All views of a stream as bytes and the checksums of their blocks.
struct ExpectedViews {
  std::optional<std::vector<uint8_t>> raw;  ///< all views, row by row; none where a block fails
  std::string blocks;                       ///< the blocks file (vectors/README.md)
};

/// Decodes all views of `decoder` block by block.
ExpectedViews expected_views(const Decoder& decoder);

}  // namespace hmlfc::vectors
