#include "stream_parts.hpp"

#include <algorithm>

#include "bits/crc32c.hpp"
#include "bits/little_endian.hpp"
#include "syntax/header.hpp"

namespace hmlfc::fuzz {
namespace {

constexpr size_t kAtHeaderBytes = 10;
constexpr size_t kAtFlags = 12;
constexpr size_t kCrcBytes = 4;

void store16(std::vector<uint8_t>& bytes, size_t at, size_t value) {
  bytes[at] = static_cast<uint8_t>(value & 0xFF);
  bytes[at + 1] = static_cast<uint8_t>((value >> 8) & 0xFF);
}

}  // namespace

std::optional<StreamParts> split(std::span<const uint8_t> file) {
  if (file.size() < header_size(0)) return std::nullopt;
  const bool has_rig = (load_le<uint32_t>(file, kAtFlags) & feature_bit(Feature::kCameraRig)) != 0;
  const size_t table_bytes = (has_rig ? 5 : 4) * kSectionEntryBytes;
  const size_t size = load_le<uint16_t>(file, kAtHeaderBytes);
  const size_t least = header_size(0) + table_bytes - 4 * kSectionEntryBytes;
  if (size < least || size > least + header_size(kMaxTreeHeight) - header_size(0) ||
      size > file.size()) {
    return std::nullopt;
  }
  StreamParts parts;
  size_t entry = size - kCrcBytes - table_bytes;
  parts.head.assign(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(entry));
  const auto take = [&] {
    const uint64_t begin = std::min<uint64_t>(load_le<uint64_t>(file, entry + 8), file.size());
    const uint64_t bytes =
        std::min<uint64_t>(load_le<uint64_t>(file, entry + 16), file.size() - begin);
    const auto section = file.subspan(static_cast<size_t>(begin), static_cast<size_t>(bytes));
    entry += kSectionEntryBytes;
    return std::vector<uint8_t>(section.begin(), section.end());
  };
  if (has_rig) parts.rig = take();
  for (auto& section : parts.sections) section = take();
  return parts;
}

std::vector<uint8_t> join(const StreamParts& parts) {
  std::vector<uint8_t> file = parts.head;
  const size_t size = file.size() + (parts.rig ? 5 : 4) * kSectionEntryBytes + kCrcBytes;
  store16(file, kAtHeaderBytes, size);
  uint64_t offset = size;
  const auto add_entry = [&](uint32_t type, const std::vector<uint8_t>& section) {
    append_le(file, type);
    append_le(file, crc32c(section));
    append_le(file, offset);
    append_le(file, uint64_t{section.size()});
    offset += section.size();
  };
  if (parts.rig) add_entry(5, *parts.rig);
  for (uint32_t i = 0; i < parts.sections.size(); ++i) add_entry(i + 1, parts.sections[i]);
  append_le(file, crc32c(file));
  if (parts.rig) file.insert(file.end(), parts.rig->begin(), parts.rig->end());
  for (const auto& section : parts.sections) {
    file.insert(file.end(), section.begin(), section.end());
  }
  return file;
}

}  // namespace hmlfc::fuzz
