#include "view/block_page.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hmlfc::view {

using cli::Json;

namespace {

Json row_json(const cli::FieldRow& row, std::span<const uint8_t> file) {
  return {{"section", row.section},
          {"address", row.address()},
          {"bits", row.bits},
          {"name", row.name},
          {"raw", raw_bits(file, row.first_bit, row.bit_count)},
          {"value", row.value},
          {"clause", row.clause}};
}

Json level_page(const cli::TracedLevel& level, const cli::BlockReport& report,
                std::span<const uint8_t> file) {
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

std::string raw_bits(std::span<const uint8_t> file, uint64_t first, uint64_t count) {
  const auto bit = [file](uint64_t at) {
    return at >> 3 < file.size() ? file[at >> 3] >> (at & 7) & 1u : 0u;
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

Json block_page(const cli::BlockReport& report, std::span<const uint8_t> file) {
  Json levels = Json::array();
  for (const cli::TracedLevel& level : report.trace.levels()) {
    levels.push_back(level_page(level, report, file));
  }
  return {{"report", to_json(report)}, {"levels", std::move(levels)}};
}

}  // namespace hmlfc::view
