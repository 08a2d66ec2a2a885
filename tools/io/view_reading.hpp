// How the names of pictures say that these are views.
#pragma once

#include <filesystem>
#include <vector>

#include "io/name_grid.hpp"
#include "io/view_list.hpp"

namespace hmlfc::io {

/// The views that `pictures`, which lie in `folder`, are by their names, as list_views() says.
IoResult<ViewList> read_names(const std::filesystem::path& folder, const ViewNaming& naming,
                              std::vector<NamedPicture> pictures);

}  // namespace hmlfc::io
