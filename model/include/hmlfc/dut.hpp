// For a decoder in C++ that hmlfc_dut.h hides: this library's types as those of the C interface.
#pragma once

#include <cstdint>

#include <hmlfc/hmlfc_dut.h>
#include <hmlfc/error.hpp>
#include <hmlfc/format.hpp>

namespace hmlfc {

/// Returns what hmlfc_dut_get_geometry reports for a stream of this header.
inline hmlfc_dut_geometry dut_geometry(const StreamHeader& header) {
  return {header.rows,
          header.cols,
          header.width,
          header.height,
          static_cast<uint32_t>(header.depth),
          static_cast<uint32_t>(header.chroma_format),
          header.block_log2,
          static_cast<uint32_t>(header.tree_height)};
}

/// The status of a function that failed with `error`: its number in annex A, [1, 27].
inline int dut_status(const Error& error) { return static_cast<int>(error.code); }

/// Returns what hmlfc_dut_error_name returns for `status`; null for a number outside annex A.
inline const char* dut_error_name(int status) {
  const bool known = status >= 0 && status < kErrorCodeCount;
  return known ? error_name(static_cast<ErrorCode>(status)).data() : nullptr;
}

}  // namespace hmlfc
