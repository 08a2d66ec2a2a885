// A block for the page: what `inspect` says of it, with the bits as they stand in the file.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "cli/block_report.hpp"
#include "cli/view_source.hpp"

namespace hmlfc::view {

/// Bits first to first + count - 1 of `bytes`, which may end before, as one number (CNV-4):
/// "0b0101" up to 16 bits, else "0x..."; empty for 0 bits.
std::string raw_bits(std::span<const uint8_t> bytes, uint64_t first, uint64_t count);

/// {"report": what `inspect --json` prints, "levels": [{"title", "formulas", "walks": [{"title",
/// "rows": [{"section", "address", "bits", "name", "raw", "value", "clause"}]}]}]}, levels from the
/// top. `report`, of a block of `file`, may end with an error.
cli::Json block_page(const cli::BlockReport& report, const cli::StreamFile& file);

}  // namespace hmlfc::view
