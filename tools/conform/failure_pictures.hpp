// Pictures of a failure: what was expected, what came, and where they differ.
#pragma once

#include <filesystem>
#include <vector>

#include "conform/difference.hpp"
#include "io/io_error.hpp"

namespace hmlfc::conform {

/// Names of the pictures of a failure, in the order in which a report shows them.
inline constexpr const char* kFailurePictures[] = {"expected.png", "actual.png", "difference.png",
                                                   "heat.png"};

/// One pixel a block of all views in their grid, with a grey pixel between views: black is equal,
/// from dark red to yellow the larger the block's worst sample. Where the grid is wider or higher
/// than 2048 pixels, only the view of number `first` is drawn.
RgbImage heat_map(const std::vector<BlockMap>& maps, uint32_t cols, size_t first, int depth);

/// Writes the four pictures into `folder`, made if it is missing: the first wrong view and the heat
/// map of all. Views of more than 8 bits are shown with their 8 upper bits. Errors: cannot write.
io::IoResult<void> write_failure_pictures(const std::filesystem::path& folder,
                                          const RgbImage& expected, const RgbImage& actual,
                                          const RgbImage& heat);

}  // namespace hmlfc::conform
