// Where decoded views differ from the golden model's, and pictures of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/image.hpp>

#include "io/io_error.hpp"

namespace hmlfc::conform {

/// The first wrong block, in raster order of views and then of blocks of plane Y, with its first
/// wrong sample; and totals.
struct Difference {
  ViewPos view;
  uint32_t block_x = 0;  ///< block of plane Y
  uint32_t block_y = 0;
  uint32_t x = 0;  ///< pixel of the view
  uint32_t y = 0;
  std::string channel;  ///< "R", "G" or "B"
  int expected = 0;
  int actual = 0;
  std::vector<Plane>
      planes;  ///< of YCoCg (COL-1) in which the block's pixels differ; not of frames
  uint64_t wrong_blocks = 0;  ///< of all views
  uint64_t blocks = 0;
  uint64_t wrong_views = 0;

  /// The block of `plane` at the same place, in a stream of this chroma format.
  BlockAddress block(Plane plane, ChromaFormat chroma) const {
    const unsigned shift = plane != Plane::kY && chroma == ChromaFormat::k420 ? 1 : 0;
    return {view, plane, block_x >> shift, block_y >> shift};
  }
};

/// The blocks of one view and how wrong each is.
struct BlockMap {
  uint32_t columns = 0;
  uint32_t rows = 0;
  std::vector<uint16_t> worst;  ///< the largest difference of a sample, 0: equal; row by row
};

/// Compares two views of one size block by block of `block_size` pixels.
BlockMap compare_blocks(const RgbImage& expected, const RgbImage& actual, unsigned block_size);

/// Compares all views block by block; nothing if they are equal.
std::optional<Difference> first_difference(const std::vector<RgbImage>& expected,
                                           const std::vector<RgbImage>& actual, uint32_t cols,
                                           unsigned block_size);

/// "plane Y", "planes Co, Cg".
std::string planes_text(const std::vector<Plane>& planes);

/// "view 0,1 block 3,2 (pixel 13,9 G): 17 instead of 18; planes Y, Cg; 4 of 96 blocks in 2 views".
std::string to_string(const Difference& difference);

/// Names of the pictures of a failure, in the order in which a report shows them.
inline constexpr const char* kFailurePictures[] = {"expected.png", "actual.png", "difference.png"};

/// Writes the pictures of the first wrong view into `folder`, which is created if missing. Of
/// samples over 8 bits, the upper 8 bits are shown. Errors: cannot write.
io::IoResult<void> write_failure_pictures(const std::filesystem::path& folder,
                                          const RgbImage& expected, const RgbImage& actual);

}  // namespace hmlfc::conform
