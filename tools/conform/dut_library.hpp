// A decoder in a shared library (hmlfc_dut.h), used in this process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <hmlfc/hmlfc_dut.h>
#include <hmlfc/decoder.hpp>

#include "io/io_error.hpp"

namespace hmlfc::conform {

/// The functions of one library, which stays loaded until the end of the process.
struct DutFunctions {
  decltype(&hmlfc_dut_abi) abi = nullptr;
  decltype(&hmlfc_dut_name) name = nullptr;
  decltype(&hmlfc_dut_open) open = nullptr;
  decltype(&hmlfc_dut_get_geometry) get_geometry = nullptr;
  decltype(&hmlfc_dut_decode_view) decode_view = nullptr;
  decltype(&hmlfc_dut_decode_block) decode_block = nullptr;
  decltype(&hmlfc_dut_trace_block) trace_block = nullptr;  ///< null where the library has none
  decltype(&hmlfc_dut_error_name) error_name = nullptr;    ///< null where the library has none
  decltype(&hmlfc_dut_close) close = nullptr;
};

/// Loads `file`. Errors: it cannot be loaded, lacks a function, or was compiled for another version
/// of the interface.
io::IoResult<DutFunctions> load_dut_library(const std::filesystem::path& file);

/// A nonzero status of a library.
struct DutError {
  std::string name;         ///< of annex A
  std::string where;        ///< "open", "view 3,2", ...
  bool cannot_run = false;  ///< the machine lacks what the library needs
};

template <class T>
using DutResult = tl::expected<T, DutError>;

/// One stream, open in a library.
class LibraryDecoder {
 public:
  /// `file` must outlive the decoder. A geometry outside the header's intervals is an error.
  static DutResult<LibraryDecoder> open(const DutFunctions& functions,
                                        std::span<const uint8_t> file);

  const hmlfc_dut_geometry& geometry() const { return geometry_; }

  /// A view, decoded by the library.
  DutResult<RgbImage> decode_view(ViewPos view) const;

  /// The same view, assembled here from blocks (COL-2, COL-3).
  DutResult<RgbImage> decode_view_by_block(ViewPos view) const;

  /// Reports the stages of one block at stop level 0 to `sink`.
  DutResult<void> trace(const BlockAddress& block, hmlfc_dut_stage_sink sink, void* context) const;

 private:
  using Handle = std::unique_ptr<hmlfc_dut, decltype(&hmlfc_dut_close)>;
  LibraryDecoder(const DutFunctions& functions, Handle handle)
      : functions_(functions), handle_(std::move(handle)) {}

  DutError error(int status, std::string where) const;
  DutResult<std::vector<int32_t>> decode_plane(ViewPos view, Plane plane, uint32_t width,
                                               uint32_t height) const;

  DutFunctions functions_;
  Handle handle_;
  hmlfc_dut_geometry geometry_{};
};

}  // namespace hmlfc::conform
