#include "syntax/header.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "bits/crc32c.hpp"
#include "bits/little_endian.hpp"
#include "syntax/extended_fields.hpp"

namespace hmlfc {
namespace {

constexpr std::array<uint8_t, 8> kMagic{0x89, 'H', 'M', 'L', 'F', 'C', 0x0D, 0x0A};

// Byte offsets of FIL-1.
constexpr size_t kAtVersion = 8;
constexpr size_t kAtProfile = 9;
constexpr size_t kAtHeaderBytes = 10;
constexpr size_t kAtFeatureFlags = 12;
constexpr size_t kAtRows = 16;
constexpr size_t kAtCols = 18;
constexpr size_t kAtWidth = 20;
constexpr size_t kAtHeight = 24;
constexpr size_t kAtDepth = 28;
constexpr size_t kAtChromaFormat = 29;
constexpr size_t kAtBlockLog2 = 30;
constexpr size_t kAtWindow = 31;
constexpr size_t kAtClusterRows = 32;
constexpr size_t kAtClusterCols = 33;
constexpr size_t kAtTreeHeight = 34;
constexpr size_t kAtReserved = 35;  // in profile main; the fields of EXT-2 in profile extended
constexpr size_t kAtReservedExtended = 40;
constexpr size_t kAtLevels = 44;
constexpr size_t kLevelEntryBytes = 4;
constexpr size_t kSectionEntryBytes = 24;
constexpr size_t kCrcBytes = 4;

tl::unexpected<Error> header_error(ErrorCode code, size_t offset) {
  return fail(code, Section::kHeader, offset);
}

Result<void> check_envelope(std::span<const uint8_t> file) {
  if (file.size() < kAtFeatureFlags) return header_error(ErrorCode::kTruncated, file.size());
  if (!std::equal(kMagic.begin(), kMagic.end(), file.begin())) {
    return header_error(ErrorCode::kBadMagic, 0);
  }
  if (file[kAtVersion] != kVersion) return header_error(ErrorCode::kBadVersion, kAtVersion);
  const size_t size = load_le<uint16_t>(file, kAtHeaderBytes);
  if (size < header_size(0)) return header_error(ErrorCode::kTruncated, kAtHeaderBytes);
  if (size > file.size()) return header_error(ErrorCode::kTruncated, file.size());
  const size_t at_crc = size - kCrcBytes;
  if (load_le<uint32_t>(file, at_crc) != crc32c(file.first(at_crc))) {
    return header_error(ErrorCode::kBadHeaderCrc, at_crc);
  }
  if (file[kAtProfile] > static_cast<uint8_t>(Profile::kExtended)) {
    return header_error(ErrorCode::kBadProfile, kAtProfile);
  }
  return {};
}

size_t reserved_offset(Profile profile) {
  return profile == Profile::kExtended ? kAtReservedExtended : kAtReserved;
}

StreamHeader load_fixed_fields(std::span<const uint8_t> file) {
  StreamHeader header;
  header.profile = static_cast<Profile>(file[kAtProfile]);
  header.feature_flags = load_le<uint32_t>(file, kAtFeatureFlags);
  header.rows = load_le<uint16_t>(file, kAtRows);
  header.cols = load_le<uint16_t>(file, kAtCols);
  header.width = load_le<uint32_t>(file, kAtWidth);
  header.height = load_le<uint32_t>(file, kAtHeight);
  header.depth = file[kAtDepth];
  header.chroma_format = static_cast<ChromaFormat>(file[kAtChromaFormat]);
  header.block_log2 = file[kAtBlockLog2];
  header.window = file[kAtWindow];
  header.cluster_rows = file[kAtClusterRows];
  header.cluster_cols = file[kAtClusterCols];
  header.tree_height = file[kAtTreeHeight];
  if (header.profile == Profile::kExtended) load_extended_fields(file, header);
  return header;
}

template <class T>
bool outside(T value, T lo, T hi) {
  return value < lo || value > hi;
}

Result<void> check_fixed_fields(const StreamHeader& h) {
  const auto bad = [](size_t at) { return header_error(ErrorCode::kBadHeaderField, at); };
  if (!has_valid_features(h)) return header_error(ErrorCode::kBadFeature, kAtFeatureFlags);
  if (outside(h.rows, 1u, kMaxGrid)) return bad(kAtRows);
  if (outside(h.cols, 1u, kMaxGrid)) return bad(kAtCols);
  if (outside(h.width, 1u, kMaxSide)) return bad(kAtWidth);
  if (outside(h.height, 1u, kMaxSide)) return bad(kAtHeight);
  if (outside(h.depth, 8, 12)) return bad(kAtDepth);
  if (h.chroma_format > ChromaFormat::k444) return bad(kAtChromaFormat);
  if (outside(h.block_log2, 1u, 3u)) return bad(kAtBlockLog2);
  if (outside(h.window, 0, kMaxWindow)) return bad(kAtWindow);
  if (outside(h.cluster_rows, 1u, 255u)) return bad(kAtClusterRows);
  if (outside(h.cluster_cols, 1u, 255u)) return bad(kAtClusterCols);
  if (outside(h.tree_height, 0, kMaxTreeHeight)) return bad(kAtTreeHeight);
  if (h.tree_height > 0 && h.cluster_rows * h.cluster_cols < 2) return bad(kAtTreeHeight);
  return check_extended_fields(h);
}

Result<void> load_levels(std::span<const uint8_t> file, StreamHeader& header) {
  header.levels.resize(static_cast<size_t>(header.tree_height) + 1);
  for (size_t i = 0; i < header.levels.size(); ++i) {
    const size_t at = kAtLevels + i * kLevelEntryBytes;
    LevelEntry& level = header.levels[header.levels.size() - 1 - i];
    level.ref_rows = file[at];
    level.ref_cols = file[at + 1];
    if (level.ref_rows == 0) return header_error(ErrorCode::kBadHeaderField, at);
    if (level.ref_cols == 0) return header_error(ErrorCode::kBadHeaderField, at + 1);
    level.key_references = file[at + 2];
    const bool allowed = header.has(Feature::kLevelKeys) && i > 0;
    if (level.key_references > (allowed ? 1 : 0)) {
      return header_error(ErrorCode::kBadHeaderField, at + 2);
    }
    if (file[at + 3] != 0) return header_error(ErrorCode::kBadHeaderField, at + 3);
  }
  return {};
}

// A size so large that the sum with its offset wraps is past the end as well.
Result<void> check_section_ends(uint64_t file_size, const StreamHeader& header) {
  for (const SectionEntry& entry : header.sections) {
    if (entry.size > file_size || entry.offset > file_size - entry.size) {
      return fail(ErrorCode::kTruncated, static_cast<Section>(entry.type), file_size);
    }
  }
  const SectionEntry& last = header.sections.back();
  if (last.offset + last.size != file_size) {
    return fail(ErrorCode::kTrailingBytes, Section::kTile, last.offset + last.size);
  }
  return {};
}

Result<void> load_sections(std::span<const uint8_t> file, StreamHeader& header) {
  const size_t size = header_size(header.tree_height);
  const size_t table = size - kCrcBytes - header.sections.size() * kSectionEntryBytes;
  uint64_t expected_offset = size;
  bool ends = true;  // the section before ends below 2^64; past it no other begins (CNV-1)
  for (size_t i = 0; i < header.sections.size(); ++i) {
    const size_t at = table + i * kSectionEntryBytes;
    SectionEntry& entry = header.sections[i];
    entry.type = load_le<uint32_t>(file, at);
    entry.crc = load_le<uint32_t>(file, at + 4);
    entry.offset = load_le<uint64_t>(file, at + 8);
    entry.size = load_le<uint64_t>(file, at + 16);
    if (entry.type != i + 1 || !ends || entry.offset != expected_offset) {
      return header_error(ErrorCode::kBadSectionTable, at);
    }
    ends = entry.size <= std::numeric_limits<uint64_t>::max() - entry.offset;
    expected_offset = ends ? entry.offset + entry.size : 0;
  }
  return check_section_ends(file.size(), header);
}

}  // namespace

Result<void> check_fields(const StreamHeader& header) {
  if (auto ok = check_fixed_fields(header); !ok) return ok;
  for (size_t i = 0; i < header.levels.size(); ++i) {
    const LevelEntry& level = header.levels[header.levels.size() - 1 - i];
    const bool key_allowed = header.has(Feature::kLevelKeys) && i > 0;
    if (level.ref_rows == 0 || level.ref_cols == 0 ||
        level.key_references > (key_allowed ? 1 : 0)) {
      return header_error(ErrorCode::kBadHeaderField, kAtLevels + i * kLevelEntryBytes);
    }
  }
  return {};
}

Result<StreamHeader> parse_header(std::span<const uint8_t> file) {
  if (auto ok = check_envelope(file); !ok) return tl::unexpected(ok.error());
  StreamHeader header = load_fixed_fields(file);
  if (auto ok = check_fixed_fields(header); !ok) return tl::unexpected(ok.error());
  const size_t at_reserved = reserved_offset(header.profile);
  const auto reserved = file.subspan(at_reserved, kAtLevels - at_reserved);
  if (std::any_of(reserved.begin(), reserved.end(), [](uint8_t byte) { return byte != 0; })) {
    return header_error(ErrorCode::kBadHeaderField, at_reserved);
  }
  if (load_le<uint16_t>(file, kAtHeaderBytes) != header_size(header.tree_height)) {
    return header_error(ErrorCode::kBadHeaderField, kAtHeaderBytes);
  }
  if (auto ok = load_levels(file, header); !ok) return tl::unexpected(ok.error());
  if (auto ok = check_fields(header); !ok) return tl::unexpected(ok.error());
  if (auto ok = load_sections(file, header); !ok) return tl::unexpected(ok.error());
  return header;
}

std::vector<uint8_t> write_header(const StreamHeader& header) {
  std::vector<uint8_t> bytes(kMagic.begin(), kMagic.end());
  const auto put8 = [&](auto value) { bytes.push_back(static_cast<uint8_t>(value)); };
  put8(kVersion);
  put8(header.profile);
  append_le(bytes, static_cast<uint16_t>(header_size(header.tree_height)));
  append_le(bytes, header.feature_flags);
  append_le(bytes, static_cast<uint16_t>(header.rows));
  append_le(bytes, static_cast<uint16_t>(header.cols));
  append_le(bytes, header.width);
  append_le(bytes, header.height);
  put8(header.depth);
  put8(header.chroma_format);
  put8(header.block_log2);
  put8(header.window);
  put8(header.cluster_rows);
  put8(header.cluster_cols);
  put8(header.tree_height);
  if (header.profile == Profile::kExtended) append_extended_fields(header, bytes);
  bytes.resize(kAtLevels, 0);
  for (auto level = header.levels.rbegin(); level != header.levels.rend(); ++level) {
    put8(level->ref_rows);
    put8(level->ref_cols);
    put8(level->key_references);
    put8(0);
  }
  for (const SectionEntry& entry : header.sections) {
    append_le(bytes, entry.type);
    append_le(bytes, entry.crc);
    append_le(bytes, entry.offset);
    append_le(bytes, entry.size);
  }
  append_le(bytes, crc32c(bytes));
  return bytes;
}

}  // namespace hmlfc
