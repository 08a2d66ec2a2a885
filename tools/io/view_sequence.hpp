// Pictures of a sequence as the views of a grid.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/name_grid.hpp"

namespace hmlfc::io {

/// One file per view, and how that was understood.
struct ViewSequence {
  std::vector<std::filesystem::path> files;  ///< row-major
  std::string text;                          ///< "3x3 views in the order of number 1 ..."
};

/// The views of `grid` from `pictures`, which come in the sorted order of their names. Where one of
/// the numbers is another in each picture, it counts them, with or without gaps. `from_0`: the
/// first number that there should be is 0. Error: too few or too many; what is missing is named, as
/// far as it is known.
tl::expected<ViewSequence, std::string> sequence_of(const std::vector<NamedPicture>& pictures,
                                                    GridShape grid, FrameOrder order, bool from_0);

/// The square grid of pictures input_CamNNN, which count from 0, or nothing.
std::optional<GridShape> square_grid(const std::vector<NamedPicture>& pictures);

}  // namespace hmlfc::io
