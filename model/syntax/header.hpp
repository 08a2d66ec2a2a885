// The file header (FIL-1 to FIL-5, EXT-1, EXT-2); parse_header is public.
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/error.hpp>
#include <hmlfc/format.hpp>
#include <hmlfc/stream_info.hpp>

namespace hmlfc {
inline constexpr uint8_t kVersion = 1;

/// Byte offset of header_bytes (FIL-1).
inline constexpr size_t kAtHeaderBytes = 10;

/// Bytes of a section entry (FIL-3).
inline constexpr uint32_t kSectionEntryBytes = 24;

/// Bytes of a header with tree_height in [0, 15] and no section RIG (FIL-1).
constexpr uint32_t header_size(int tree_height) {
  return 44 + 4 * static_cast<uint32_t>(tree_height + 1) + 4 * kSectionEntryBytes + 4;
}

/// Bytes of `header` (FIL-1).
inline uint32_t header_size(const StreamHeader& header) {
  return header_size(header.tree_height) +
         (header.has(Feature::kCameraRig) ? kSectionEntryBytes : 0);
}

/// The section entries of `header`, a StreamHeader or a const one, in their order (FIL-1).
template <class Header>
auto section_entries(Header& header) {
  std::vector<decltype(&header.rig)> entries;
  if (header.has(Feature::kCameraRig)) entries.push_back(&header.rig);
  for (auto& entry : header.sections) entries.push_back(&entry);
  return entries;
}

/// Checks every field but the section table against its interval (FIL-4), in the order of FIL-1.
Result<void> check_fields(const StreamHeader& header);

/// The header's bytes, header_crc included.
std::vector<uint8_t> write_header(const StreamHeader& header);

}  // namespace hmlfc
