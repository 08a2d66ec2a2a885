// Where the bytes of a stream go.
#pragma once

#include <array>
#include <cstdint>

namespace hmlfc {

/// Bytes of the file by their content. Motion and residual are bits rounded down to bytes; the rest
/// of section TILE counts as index. The sum is the file's size.
struct SectionBytes {
  uint64_t header = 0;    ///< FIL-1 to FIL-3
  uint64_t index = 0;     ///< ROOT, GROUP, end tables, modes and masks
  uint64_t motion = 0;    ///< sign_mode to vectors_y of all tiles, and all fields of motion tiles
  uint64_t residual = 0;  ///< level_base to the last block value of all tiles
  uint64_t top = 0;       ///< key images
  uint64_t other = 0;     ///< RIG

  /// The file's size.
  uint64_t total() const { return header + index + motion + residual + top + other; }
};

/// The contents of a stream.
struct StreamStatistics {
  SectionBytes sections;             ///< bytes by content
  std::array<uint64_t, 4> states{};  ///< blocks by BlockState, over all images but the key images
};

}  // namespace hmlfc
