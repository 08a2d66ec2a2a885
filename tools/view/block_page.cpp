#include "view/block_page.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hmlfc::view {

using cli::Json;

namespace {

// raw_bits of the file, which may end before.
std::string raw_bits_of(const cli::StreamFile& file, uint64_t first, uint64_t count) {
  const uint64_t begin = std::min(first / 8, file.size());
  const uint64_t end = std::min((first + count + 7) / 8, file.size());
  std::string bits;
  file.with_bytes({begin, end - begin}, [&](std::span<const uint8_t> bytes) {
    bits = raw_bits(bytes, first - 8 * begin, count);
  });
  return bits;
}

Json row_json(const cli::FieldRow& row, const cli::StreamFile& file) {
  return {{"section", row.section},
          {"address", row.address()},
          {"bits", row.bits},
          {"name", row.name},
          {"raw", raw_bits_of(file, row.first_bit, row.bit_count)},
          {"value", row.value},
          {"clause", row.clause}};
}

Json level_page(const cli::TracedLevel& level, const cli::BlockReport& report,
                const cli::StreamFile& file) {
  Json walks = Json::array();
  for (const cli::TracedWalk& walk : level.walks) {
    Json rows = Json::array();
    for (const cli::FieldRow& row : field_rows(walk, report.header)) {
      rows.push_back(row_json(row, file));
    }
    walks.push_back({{"title", describe_walk(level, walk)}, {"rows", std::move(rows)}});
  }
  return {{"title", describe_image(level, report.header)},
          {"formulas", formulas(level, report.header, report.block.plane)},
          {"walks", std::move(walks)}};
}

}  // namespace

std::string raw_bits(std::span<const uint8_t> bytes, uint64_t first, uint64_t count) {
  const auto bit = [bytes](uint64_t at) {
    return at >> 3 < bytes.size() ? bytes[at >> 3] >> (at & 7) & 1u : 0u;
  };
  if (count == 0) return "";
  const bool binary = count <= 16;
  const uint64_t digit_bits = binary ? 1 : 4;
  std::string digits;
  for (uint64_t at = 0; at < count; at += digit_bits) {
    unsigned digit = 0;
    for (uint64_t k = 0; k < digit_bits && at + k < count; ++k) digit |= bit(first + at + k) << k;
    digits += "0123456789abcdef"[digit];
  }
  std::ranges::reverse(digits);
  return (binary ? "0b" : "0x") + digits;
}

Json block_page(const cli::BlockReport& report, const cli::StreamFile& file) {
  Json levels = Json::array();
  for (const cli::TracedLevel& level : report.trace.levels()) {
    levels.push_back(level_page(level, report, file));
  }
  return {{"report", to_json(report)}, {"levels", std::move(levels)}};
}

}  // namespace hmlfc::view
