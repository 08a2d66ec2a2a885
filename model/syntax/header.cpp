#include "syntax/header.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "bits/crc32c.hpp"
#include "bits/little_endian.hpp"

namespace hmlfc {
namespace {

constexpr std::array<uint8_t, 8> kMagic{0x89, 'H', 'M', 'L', 'F', 'C', 0x0D, 0x0A};

// Byte offsets of FIL-1.
constexpr size_t kAtVersion = 8;
constexpr size_t kAtProfile = 9;
constexpr size_t kAtFeatureFlags = 12;
constexpr size_t kAtFields = 16;  // rows and the fields after it: each_field
constexpr size_t kAtReserved = 35;
constexpr size_t kAtReservedExtended = 40;
constexpr size_t kAtLevels = 44;
constexpr size_t kLevelEntryBytes = 4;
constexpr size_t kCrcBytes = 4;

// Flags that need motion tiles (EXT-1).
constexpr uint32_t kNeedMotionTiles =
    feature_bit(Feature::kSubpelVectors) | feature_bit(Feature::kSharedDisparity) |
    feature_bit(Feature::kTwoReferences) | feature_bit(Feature::kChromaMotion);

tl::unexpected<Error> header_error(ErrorCode code, size_t offset) {
  return fail(code, Section::kHeader, offset);
}

tl::unexpected<Error> bad_field(size_t offset) {
  return header_error(ErrorCode::kBadHeaderField, offset);
}

// Calls visit(field, bytes, lo, hi) for the fields from rows to tree_height (FIL-1), in their order
// and without gaps, then for those of EXT-2. An interval may depend on earlier fields.
template <class Header, class Visit>
void each_field(Header& h, const Visit& visit) {
  visit(h.rows, 2, 1, kMaxGrid);
  visit(h.cols, 2, 1, kMaxGrid);
  visit(h.width, 4, 1, kMaxSide);
  visit(h.height, 4, 1, kMaxSide);
  visit(h.depth, 1, 8, 12);
  visit(h.chroma_format, 1, 0, 1);
  visit(h.block_log2, 1, 1, 3);
  visit(h.window, 1, 0, kMaxWindow);
  visit(h.cluster_rows, 1, 1, 255);
  visit(h.cluster_cols, 1, 1, 255);
  visit(h.tree_height, 1, 0, h.cluster_rows * h.cluster_cols < 2 ? 0 : kMaxTreeHeight);
}

// A field whose flag is not set is 0.
template <class Header, class Visit>
void each_extended_field(Header& h, const Visit& visit) {
  const auto field = [&](auto& value, Feature flag, int64_t lo, int64_t hi) {
    visit(value, 1, h.has(flag) ? lo : 0, h.has(flag) ? hi : 0);
  };
  field(h.vector_precision, Feature::kSubpelVectors, 1, 3);
  field(h.disparity_precision, Feature::kSharedDisparity, h.vector_precision, 5);
  field(h.motion_tile_log2, Feature::kMotionTiles, 5, 7);
  field(h.disparity_grid_log2, Feature::kSharedDisparity, 2, 5);
  field(h.row_scale, Feature::kSharedDisparity, -127, 127);
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

StreamHeader load_fixed_fields(std::span<const uint8_t> file) {
  StreamHeader header;
  header.profile = static_cast<Profile>(file[kAtProfile]);
  header.feature_flags = load_le<uint32_t>(file, kAtFeatureFlags);
  size_t at = kAtFields;
  const auto load = [&]<class T>(T& field, size_t bytes, int64_t lo, int64_t) {
    uint32_t value = 0;
    for (size_t i = 0; i < bytes; ++i) value |= uint32_t{file[at++]} << (8 * i);
    field = static_cast<T>(lo < 0 ? int64_t{static_cast<int8_t>(value)} : int64_t{value});
  };
  each_field(header, load);
  if (header.profile == Profile::kExtended) each_extended_field(header, load);
  return header;
}

bool has_valid_features(const StreamHeader& header) {
  if (header.profile == Profile::kMain) return header.feature_flags == 0;
  if ((header.feature_flags >> kFeatureCount) != 0) return false;
  return header.has(Feature::kMotionTiles) || (header.feature_flags & kNeedMotionTiles) == 0;
}

Result<void> check_fixed_fields(const StreamHeader& header) {
  if (!has_valid_features(header)) return header_error(ErrorCode::kBadFeature, kAtFeatureFlags);
  size_t at = kAtFields;
  std::optional<size_t> bad;
  const auto check = [&](auto field, size_t bytes, int64_t lo, int64_t hi) {
    const auto value = static_cast<int64_t>(field);
    if (!bad && (value < lo || value > hi)) bad = at;
    at += bytes;
  };
  each_field(header, check);
  each_extended_field(header, check);
  if (bad) return bad_field(*bad);
  return {};
}

// Offset of the entry of `level`: the top level's comes first.
size_t level_offset(const StreamHeader& header, size_t level) {
  return kAtLevels + (header.levels.size() - 1 - level) * kLevelEntryBytes;
}

Result<void> check_level(const StreamHeader& header, size_t level) {
  const LevelEntry& entry = header.levels[level];
  const size_t at = level_offset(header, level);
  if (entry.ref_rows == 0) return bad_field(at);
  if (entry.ref_cols == 0) return bad_field(at + 1);
  const bool top = level + 1 == header.levels.size();
  if (entry.key_references > (header.has(Feature::kLevelKeys) && !top ? 1 : 0)) {
    return bad_field(at + 2);
  }
  return {};
}

Result<void> load_levels(std::span<const uint8_t> file, StreamHeader& header) {
  header.levels.resize(static_cast<size_t>(header.tree_height) + 1);
  for (size_t end = header.levels.size(); end > 0; --end) {  // the top level's entry comes first
    const size_t level = end - 1;
    const size_t at = level_offset(header, level);
    header.levels[level] = {file[at], file[at + 1], file[at + 2]};
    if (auto ok = check_level(header, level); !ok) return ok;
    if (file[at + 3] != 0) return bad_field(at + 3);
  }
  return {};
}

// A size whose sum with the offset would wrap is past the end as well.
Result<void> check_section_ends(uint64_t file_size, const StreamHeader& header) {
  for (const SectionEntry* entry : section_entries(header)) {
    if (entry->size > file_size || entry->offset > file_size - entry->size) {
      return fail(ErrorCode::kTruncated, static_cast<Section>(entry->type), file_size);
    }
  }
  const SectionEntry& last = header.sections.back();
  if (last.offset + last.size != file_size) {
    return fail(ErrorCode::kTrailingBytes, Section::kTile, last.offset + last.size);
  }
  return {};
}

Result<void> load_sections(std::span<const uint8_t> file, StreamHeader& header) {
  const size_t size = header_size(header);
  size_t at = header_size(header.tree_height) - kCrcBytes - 4 * size_t{kSectionEntryBytes};
  uint64_t expected_offset = size;
  bool ends = true;  // the section before ends below 2^64; past it no other begins (CNV-1)
  uint32_t type = header.has(Feature::kCameraRig) ? static_cast<uint32_t>(Section::kRig) : 1;
  for (SectionEntry* place : section_entries(header)) {
    SectionEntry& entry = *place;
    entry.type = load_le<uint32_t>(file, at);
    entry.crc = load_le<uint32_t>(file, at + 4);
    entry.offset = load_le<uint64_t>(file, at + 8);
    entry.size = load_le<uint64_t>(file, at + 16);
    if (entry.type != type || !ends || entry.offset != expected_offset) {
      return header_error(ErrorCode::kBadSectionTable, at);
    }
    type = place == &header.rig ? 1 : type + 1;
    at += kSectionEntryBytes;
    ends = entry.size <= std::numeric_limits<uint64_t>::max() - entry.offset;
    expected_offset = ends ? entry.offset + entry.size : 0;
  }
  return check_section_ends(file.size(), header);
}

}  // namespace

Result<void> check_fields(const StreamHeader& header) {
  if (auto ok = check_fixed_fields(header); !ok) return ok;
  for (size_t end = header.levels.size(); end > 0; --end) {
    if (auto ok = check_level(header, end - 1); !ok) return ok;
  }
  return {};
}

Result<StreamHeader> parse_header(std::span<const uint8_t> file) {
  if (auto ok = check_envelope(file); !ok) return tl::unexpected(ok.error());
  StreamHeader header = load_fixed_fields(file);
  if (auto ok = check_fixed_fields(header); !ok) return tl::unexpected(ok.error());
  const size_t at_reserved =
      header.profile == Profile::kExtended ? kAtReservedExtended : kAtReserved;
  const auto reserved = file.subspan(at_reserved, kAtLevels - at_reserved);
  if (std::ranges::any_of(reserved, [](uint8_t byte) { return byte != 0; })) {
    return bad_field(at_reserved);
  }
  if (load_le<uint16_t>(file, kAtHeaderBytes) != header_size(header)) {
    return bad_field(kAtHeaderBytes);
  }
  if (auto ok = load_levels(file, header); !ok) return tl::unexpected(ok.error());
  if (auto ok = load_sections(file, header); !ok) return tl::unexpected(ok.error());
  return header;
}

std::vector<uint8_t> write_header(const StreamHeader& header) {
  std::vector<uint8_t> bytes(kMagic.begin(), kMagic.end());
  append_le(bytes, kVersion);
  append_le(bytes, static_cast<uint8_t>(header.profile));
  append_le(bytes, static_cast<uint16_t>(header_size(header)));
  append_le(bytes, header.feature_flags);
  const auto put = [&](auto field, size_t count, int64_t, int64_t) {
    const auto value = static_cast<uint32_t>(field);
    for (size_t i = 0; i < count; ++i) bytes.push_back(static_cast<uint8_t>(value >> (8 * i)));
  };
  each_field(header, put);
  if (header.profile == Profile::kExtended) each_extended_field(header, put);
  bytes.resize(kAtLevels, 0);
  for (auto level = header.levels.rbegin(); level != header.levels.rend(); ++level) {
    bytes.insert(bytes.end(), {level->ref_rows, level->ref_cols, level->key_references, 0});
  }
  for (const SectionEntry* entry : section_entries(header)) {
    append_le(bytes, entry->type);
    append_le(bytes, entry->crc);
    append_le(bytes, entry->offset);
    append_le(bytes, entry->size);
  }
  append_le(bytes, crc32c(bytes));
  return bytes;
}

}  // namespace hmlfc
