// Cameras as the parameters.cfg of the 4D Light Field Benchmark (HCI) states them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include <hmlfc/light_field.hpp>
#include <hmlfc/rig.hpp>

#include "io/io_error.hpp"
#include "io/view_list.hpp"

namespace hmlfc::io {

/// The name of the file, in the folder of its views.
inline constexpr std::string_view kHciParametersName = "parameters.cfg";

/// Parallel cameras on a square grid in a plane, whose pictures are shifted so that a point at the
/// distance of focus is at the same pixel of all.
struct HciParameters {
  GridShape grid;               ///< num_cams_y, num_cams_x: [1, 4096] each
  uint32_t width = 0;           ///< image_resolution_x_px, [1, 65536]
  uint32_t height = 0;          ///< image_resolution_y_px, [1, 65536]
  double focal_length_mm = 0;   ///< above 0
  double sensor_size_mm = 0;    ///< along the longer side of a picture, above 0
  double baseline_mm = 0;       ///< between neighbours, above 0
  double focus_distance_m = 0;  ///< 0: at infinity
};

/// The members above in `text`, an INI file; all others are left alone. Error: the line, or the
/// section and the member, that is wrong.
tl::expected<HciParameters, std::string> parse_hci_parameters(std::string_view text);

/// parse_hci_parameters() of a file. Error: also one that cannot be read.
IoResult<HciParameters> read_hci_parameters(const std::filesystem::path& file);

/// The grid that the parameters.cfg of `folder` states, whatever else it has; nothing without a
/// file. Errors as above.
IoResult<std::optional<GridShape>> hci_grid(const std::filesystem::path& folder);

/// The rig of `views`, of the size in `shape`: in metres, the world's axes and origin are those of
/// the middle camera. Files input_CamNNN may be a part of the grid; else it has to be that of the
/// views. Error: a view or grid that is not the file's.
tl::expected<Rig, std::string> rig_of_hci(const HciParameters& parameters, const ViewList& views,
                                          const LightFieldShape& shape);

/// The parameters of `rig`, whose unit is a metre if it does not say; the sensor has 35 mm. Error:
/// the first view whose camera is not one of such a grid, and why.
tl::expected<HciParameters, std::string> hci_parameters_of(const Rig& rig,
                                                           const LightFieldShape& shape);

/// The file of `parameters`, with all members that the benchmark's programs read; what is not known
/// is nan or empty.
std::string hci_parameters_text(const HciParameters& parameters);

}  // namespace hmlfc::io
