#include <hmlfc/rig.hpp>

#include <hmlfc/stream_info.hpp>

#include "bits/crc32c.hpp"
#include "syntax/header.hpp"

namespace hmlfc {

std::span<const uint8_t> rig_of(std::span<const uint8_t> file, const StreamHeader& header) {
  return file.subspan(static_cast<size_t>(header.rig.offset), static_cast<size_t>(header.rig.size));
}

Result<std::vector<uint8_t>> with_rig(std::span<const uint8_t> file, std::span<const uint8_t> rig) {
  auto header = parse_header(file);
  if (!header) return tl::unexpected(header.error());
  if (header->profile == Profile::kMain) return fail(ErrorCode::kBadFeature, Section::kHeader, 9);
  const auto others = file.subspan(static_cast<size_t>(header->sections.front().offset));
  header->feature_flags |= feature_bit(Feature::kCameraRig);
  uint64_t offset = header_size(*header);
  header->rig = {static_cast<uint32_t>(Section::kRig), crc32c(rig), offset, rig.size()};
  offset += rig.size();
  for (SectionEntry& entry : header->sections) {
    entry.offset = offset;
    offset += entry.size;
  }
  std::vector<uint8_t> bytes = write_header(*header);
  bytes.reserve(static_cast<size_t>(offset));
  bytes.insert(bytes.end(), rig.begin(), rig.end());
  bytes.insert(bytes.end(), others.begin(), others.end());
  return bytes;
}

}  // namespace hmlfc
