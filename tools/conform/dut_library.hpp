// The functions of a decoder in a shared library (hmlfc_dut.h).
#pragma once

#include <filesystem>

#include <hmlfc/hmlfc_dut.h>

#include "io/io_error.hpp"

namespace hmlfc::conform {

/// The functions of hmlfc_dut.h; those of a library stay loaded until the end of the process.
struct DutFunctions {
  decltype(&hmlfc_dut_abi) abi = nullptr;
  decltype(&hmlfc_dut_name) name = nullptr;
  decltype(&hmlfc_dut_open) open = nullptr;
  decltype(&hmlfc_dut_get_geometry) get_geometry = nullptr;
  decltype(&hmlfc_dut_decode_view) decode_view = nullptr;
  decltype(&hmlfc_dut_decode_block) decode_block = nullptr;
  decltype(&hmlfc_dut_trace_block) trace_block = nullptr;      ///< null where the library has none
  decltype(&hmlfc_dut_frame_record) frame_record = nullptr;    ///< null like the one before
  decltype(&hmlfc_dut_render_frame) render_frame = nullptr;    ///< the same
  decltype(&hmlfc_dut_trace_pixel) trace_pixel = nullptr;      ///< the same
  decltype(&hmlfc_dut_disparity_map) disparity_map = nullptr;  ///< the same
  decltype(&hmlfc_dut_error_name) error_name = nullptr;        ///< null where the library has none
  decltype(&hmlfc_dut_close) close = nullptr;
};

/// Loads `file`. Errors: it cannot be loaded, lacks a function, or was compiled for another version
/// of the interface.
io::IoResult<DutFunctions> load_dut_library(const std::filesystem::path& file);

}  // namespace hmlfc::conform
