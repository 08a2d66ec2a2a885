// View positions from file names.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hmlfc::io {

/// Compares text byte by byte and each run of decimal digits, of any length, as one number.
/// Equal for names that differ only in leading zeros: natural_order("a7", "a007") == 0.
std::strong_ordering natural_order(std::string_view a, std::string_view b);

/// A camera's place as the Stanford archive states it.
struct CameraPlace {
  double y = 0;
  double x = 0;

  friend bool operator==(const CameraPlace&, const CameraPlace&) = default;
};

/// Y and X from a name of the form out_RR_CC_Y_X or out_RR_CC_Y_X_. Nothing for any other name.
std::optional<CameraPlace> parse_camera_place(std::string_view stem);

/// NNN from "input_CamNNN" (HCI benchmark), 1 to 8 digits. Nothing for any other name.
std::optional<uint32_t> parse_camera_name(std::string_view stem);

/// "RR_CC" with as many digits as the longer side of the grid needs, at least 2.
/// view_stem(3, 4, 16, 16) = "03_04", view_stem(0, 100, 1, 101) = "000_100".
std::string view_stem(uint32_t row, uint32_t col, uint32_t rows, uint32_t cols);

/// view_stem(...) + ".png"; list_views() reads a folder of such names back.
std::string view_file_name(uint32_t row, uint32_t col, uint32_t rows, uint32_t cols);

/// "input_CamNNN.png" (HCI benchmark) of the view `index`, counted row by row, at least 3 digits.
std::string camera_file_name(uint32_t index);

/// "CCC_RRR.ppm" as JPEG Pleno's test data: the column first, at least 3 digits each.
std::string pleno_file_name(uint32_t row, uint32_t col);

}  // namespace hmlfc::io
