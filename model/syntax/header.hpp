// The file header (FIL-1 to FIL-5, EXT-1, EXT-2); parse_header is public.
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/error.hpp>
#include <hmlfc/format.hpp>
#include <hmlfc/stream_info.hpp>

namespace hmlfc {
inline constexpr uint8_t kVersion = 1;

/// Bytes of a header with tree_height in [0, 15] (FIL-1).
constexpr uint32_t header_size(int tree_height) {
  return 44 + 4 * static_cast<uint32_t>(tree_height + 1) + 96 + 4;
}

/// Checks every field but the section table against its interval (FIL-4), in the order of FIL-1.
Result<void> check_fields(const StreamHeader& header);

/// The header's bytes, header_crc included.
std::vector<uint8_t> write_header(const StreamHeader& header);

}  // namespace hmlfc
