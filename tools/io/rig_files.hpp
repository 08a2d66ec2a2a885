// Where the cameras of a folder of views stand.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include <hmlfc/light_field.hpp>
#include <hmlfc/rig.hpp>

#include "io/io_error.hpp"
#include "io/view_list.hpp"

namespace hmlfc::io {

/// The rig of `views`, of the size in `shape`, in `file`: a rig in JSON as in a stream (RIG-2), of
/// these views or of all of the grid they are a part of, a transforms.json (rig_of_transforms) or,
/// named *.cfg, a parameters.cfg (rig_of_hci). Errors name file and member.
IoResult<Rig> read_rig(const std::filesystem::path& file, const ViewList& views,
                       const LightFieldShape& shape);

/// The name under which a folder of views holds its rig.
inline constexpr std::string_view kRigName = "rig.json";

/// The rig that lies beside the views: read_rig() of the rig.json of their folder, else of its
/// parameters.cfg; nothing without both.
IoResult<std::optional<Rig>> rig_beside(const ViewList& views, const LightFieldShape& shape);

/// The positions that the file names of the Stanford archive state, out_RR_CC_Y_X; nothing where a
/// view has another name. x is X or -X, whichever grows with the columns, y is Y or -Y, whichever
/// grows with the rows: the archive does not say how its axes lie in the pictures. z is 0, the unit
/// is not known. Error: a position outside the range of RIG-2.
IoResult<std::optional<Rig>> rig_of_names(const ViewList& views);

}  // namespace hmlfc::io
