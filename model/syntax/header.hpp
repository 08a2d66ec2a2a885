// The file header (FIL-1 to FIL-5).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <hmlfc/error.hpp>
#include <hmlfc/format.hpp>

namespace hmlfc {

inline constexpr uint8_t kVersion = 1;
inline constexpr uint32_t kMaxGrid = 4096;
inline constexpr uint32_t kMaxSide = 65536;
inline constexpr int kMaxTreeHeight = 15;
inline constexpr int kMaxWindow = 127;

/// Bytes of a header with tree_height in [0, 15] (FIL-1).
constexpr uint32_t header_size(int tree_height) {
  return 44 + 4 * static_cast<uint32_t>(tree_height + 1) + 96 + 4;
}

/// Reads and checks the header at the start of `file`, the whole file (FIL-4). Sections are checked
/// for their place, not for their content.
Result<StreamHeader> parse_header(std::span<const uint8_t> file);

/// Checks every field but the section table against its interval (FIL-4), in the order of FIL-1.
Result<void> check_fields(const StreamHeader& header);

/// The header's bytes, header_crc included.
std::vector<uint8_t> write_header(const StreamHeader& header);

}  // namespace hmlfc
