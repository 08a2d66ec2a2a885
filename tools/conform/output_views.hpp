// The views that a decoder under test wrote.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <hmlfc/disparity.hpp>
#include <hmlfc/image.hpp>
#include <hmlfc/light_field.hpp>

#include "io/io_error.hpp"

namespace hmlfc::conform {

/// The file of the raw form (vectors/README.md): all views row by row; of each view its pixels row
/// by row, R, G, B; samples of one byte at depth 8, of two bytes, little-endian, above.
inline constexpr const char* kRawViewsName = "views.raw";

/// Reads all views of `folder`, row by row, each with the size and depth of `shape`: from views.raw
/// if it exists, otherwise from PNG or PPM files named as `hmlfc decode` names them.
/// Errors: a view is missing, duplicate, unreadable, or has another size or depth; a sample of
/// views.raw is out of range.
io::IoResult<std::vector<RgbImage>> read_output_views(const std::filesystem::path& folder,
                                                      const LightFieldShape& shape);

/// The frame in `folder`: one of frame.raw (raw form), frame.png and frame.ppm. Errors: as above,
/// or two of them.
io::IoResult<RgbImage> read_output_frame(const std::filesystem::path& folder, uint32_t width,
                                         uint32_t height, int depth);

/// The map of this many blocks in `folder`: map.raw (vectors/README.md).
io::IoResult<std::vector<BlockDisparity>> read_output_map(const std::filesystem::path& folder,
                                                          size_t blocks);

}  // namespace hmlfc::conform
