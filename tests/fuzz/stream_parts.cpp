#include "stream_parts.hpp"

#include <algorithm>

#include "bits/crc32c.hpp"
#include "bits/little_endian.hpp"
#include "syntax/header.hpp"

namespace hmlfc::fuzz {
namespace {

constexpr size_t kAtHeaderBytes = 10;
constexpr size_t kSectionEntryBytes = 24;
constexpr size_t kTableBytes = 4 * kSectionEntryBytes;
constexpr size_t kCrcBytes = 4;

void store16(std::vector<uint8_t>& bytes, size_t at, size_t value) {
  bytes[at] = static_cast<uint8_t>(value & 0xFF);
  bytes[at + 1] = static_cast<uint8_t>((value >> 8) & 0xFF);
}

}  // namespace

std::optional<StreamParts> split(std::span<const uint8_t> file) {
  if (file.size() < header_size(0)) return std::nullopt;
  const size_t size = load_le<uint16_t>(file, kAtHeaderBytes);
  if (size < header_size(0) || size > header_size(kMaxTreeHeight) || size > file.size()) {
    return std::nullopt;
  }
  StreamParts parts;
  const size_t table = size - kCrcBytes - kTableBytes;
  parts.head.assign(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(table));
  for (size_t i = 0; i < parts.sections.size(); ++i) {
    const size_t entry = table + i * kSectionEntryBytes;
    const uint64_t begin = std::min<uint64_t>(load_le<uint64_t>(file, entry + 8), file.size());
    const uint64_t bytes =
        std::min<uint64_t>(load_le<uint64_t>(file, entry + 16), file.size() - begin);
    const auto section = file.subspan(static_cast<size_t>(begin), static_cast<size_t>(bytes));
    parts.sections[i].assign(section.begin(), section.end());
  }
  return parts;
}

std::vector<uint8_t> join(const StreamParts& parts) {
  std::vector<uint8_t> file = parts.head;
  const size_t size = file.size() + kTableBytes + kCrcBytes;
  store16(file, kAtHeaderBytes, size);
  uint64_t offset = size;
  for (uint32_t i = 0; i < parts.sections.size(); ++i) {
    append_le(file, i + 1);
    append_le(file, crc32c(parts.sections[i]));
    append_le(file, offset);
    append_le(file, uint64_t{parts.sections[i].size()});
    offset += parts.sections[i].size();
  }
  append_le(file, crc32c(file));
  for (const auto& section : parts.sections) {
    file.insert(file.end(), section.begin(), section.end());
  }
  return file;
}

}  // namespace hmlfc::fuzz
