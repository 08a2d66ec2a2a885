// All views of a light field in one picture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include <hmlfc/image.hpp>
#include <hmlfc/light_field.hpp>

#include "io/io_error.hpp"
#include "io/view_list.hpp"

namespace hmlfc::io {

/// Where the pixels of a view lie.
enum class MosaicLayout : uint8_t {
  kQuilt,     ///< views of one row of cameras, from the left, in tiles from the bottom left upwards
  kTiles,     ///< view (r, c) is the tile in row r and column c
  kLenslets,  ///< pixel (x, y) of view (r, c) is pixel (x * cols + c, y * rows + r)
};

/// How a picture holds views.
struct Mosaic {
  MosaicLayout layout = MosaicLayout::kTiles;
  uint32_t rows = 1;  ///< of tiles, or of pixels under a lenslet, [1, 4096]
  uint32_t cols = 1;  ///< likewise; a quilt has at most 4096 tiles

  /// The grid of the views: rows x cols, of a quilt 1 x (rows * cols).
  GridShape grid() const;
};

/// The quilt of a name with _qsCxRaA or _qsCxR, in any case, at its end or before a space, (, - or
/// _: C columns and R rows in [1, 4096] with C * R <= 4096, and its aspect A, the width of what a
/// view shows over its height. Nothing for other names.
struct QuiltName {
  Mosaic mosaic;
  std::optional<double> aspect;  ///< above 0
};
std::optional<QuiltName> parse_quilt_name(const std::filesystem::path& file);

/// The shape of the light field in `picture`. What a quilt has too much, on the right and on top,
/// belongs to no view. Errors, which name `file`: sides of other layouts that are no multiples of
/// those of the mosaic, views without pixels.
IoResult<LightFieldShape> mosaic_shape(const std::filesystem::path& file, const RgbImage& picture,
                                       const Mosaic& mosaic);

/// View (row, col) of a picture that mosaic_shape accepts.
RgbImage view_of_mosaic(const RgbImage& picture, const Mosaic& mosaic, uint32_t row, uint32_t col);

/// A black picture for a light field of `shape` with the grid of `mosaic`. Errors, which name
/// `file`: a side over 65536 or more than 2^31 samples.
IoResult<RgbImage> empty_mosaic(const std::filesystem::path& file, const LightFieldShape& shape,
                                const Mosaic& mosaic);

/// Writes `view` to its place in `picture`. Several threads may write different views.
void put_into_mosaic(RgbImage& picture, const Mosaic& mosaic, uint32_t row, uint32_t col,
                     const RgbImage& view);

}  // namespace hmlfc::io
