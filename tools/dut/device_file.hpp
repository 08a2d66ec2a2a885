// The capability file: what a device under hmlfc_checker.sv decodes and shows (docs/checker.md).
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "dut/claims.hpp"
#include "io/io_error.hpp"

namespace hmlfc::lockstep {

/// The stages that a device may show, in the order of hmlfc_checker.h.
inline constexpr std::array<std::string_view, 4> kStageNames{"residual", "reference", "prediction",
                                                             "sample"};

/// Defaults are those of a device that decodes everything and shows answers alone.
struct Device {
  std::string name = "device";
  Claims claims;
  bool rgb = true;               ///< takes requests for plane 3
  bool stop_levels = true;       ///< takes stop levels other than 0
  std::array<bool, 4> stages{};  ///< shows them
  bool every_stage = true;       ///< each level of each block has a record
  bool held_chroma = false;      ///< but for chroma of the request for RGB before
  bool tagged = false;           ///< answers come in any order, with the request's tag
  bool bus_errors = false;       ///< any answer may be bus_error
  bool checks_sections = true;   ///< FIL-6

  bool shows_stages() const;
};

/// Reads a JSON object. Errors, which name the file: not readable, a member that is unknown or has
/// a wrong value, no member profile.
io::IoResult<Device> read_device(const std::filesystem::path& file);

}  // namespace hmlfc::lockstep
