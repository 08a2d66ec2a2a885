// A plane of a view that a query asks for, or a view alone, and its picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "cli/block_request.hpp"
#include "view/exchange.hpp"

namespace hmlfc::view {

struct PlaneRequest {
  std::optional<ViewPos> view;
  Plane plane = Plane::kY;
  std::optional<int> levels;  ///< of the tree, from the top; else all
};

/// Reads a query with view and levels, with `plane` or without, and what `add` adds. Failures:
/// those of read_query().
PlaneRequest read_plane_request(const Query& query, bool plane,
                                const std::function<void(CLI::App&, PlaneRequest&)>& add = nullptr);

/// The stop level of `request`, whose view is in the grid. Usage failures: it is not, or levels
/// that the stream has not.
int stop_level(const cli::StreamFile& file, const PlaneRequest& request);

/// The view in RGB, down to its stop level. Failures: those of stop_level(), a corrupt stream.
RgbImage decoded(const cli::StreamFile& file, const PlaneRequest& request);

/// An answer with four bytes a pixel, as a canvas takes them: R, G, B and 255, row by row, the
/// upper 8 bits of each sample. The header Picture-Size has "width,height".
Response picture_answer(const RgbImage& image);

/// The view of `other` in RGB or, with `difference`, 128 + gain * (it - decoded); `gain` in
/// [1, 64], 4 by default.
Response other_picture(const cli::StreamFile& file, const Query& query, bool difference,
                       const std::function<RgbImage(ViewPos)>& other);

/// Pixels of a view that are a side of a block of the plane: B, or 2 B where chroma has half the
/// size.
uint32_t block_pixels(const StreamHeader& header, Plane plane);

}  // namespace hmlfc::view
