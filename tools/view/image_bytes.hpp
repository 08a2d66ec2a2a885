// Where a stream's bytes are by image, plane and level, and what its residuals use.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include <hmlfc/decoder.hpp>

namespace hmlfc::view {

/// Bytes of one level, of tile records and of codestreams of key images. The index is nobody's.
struct LevelBytes {
  int level = 0;
  uint32_t rows = 0;  ///< of images
  uint32_t cols = 0;
  std::vector<uint64_t> images;                    ///< by image, row by row
  std::array<uint64_t, kPlaneCount> planes{};      ///< of tile records by plane
  std::array<uint64_t, kPlaneCount> key_planes{};  ///< of codestreams by plane
  uint64_t motion_tiles = 0;
};

/// All levels from the top, and the residuals of all blocks of all images.
struct ImageBytes {
  std::vector<LevelBytes> levels;
  std::map<uint32_t, uint64_t> level_counts;  ///< blocks by N, the level count of their values
  std::map<uint32_t, uint64_t> steps;         ///< blocks by step; none without steps (STP-1)
};

/// Reads the head of every tile and the header of every block. Errors: those of decoding.
Result<ImageBytes> image_bytes(const Decoder& decoder);

}  // namespace hmlfc::view
