// Putting the parts of a stream together (FIL-1, KEY-1).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <hmlfc/format.hpp>

#include "bits/crc32c.hpp"
#include "syntax/index.hpp"

namespace hmlfc {

/// The TOP section: table and codestreams of the planes of all key images, in order, with the
/// CRC-32C of the samples of each.
std::vector<uint8_t> top_section(std::span<const std::vector<uint8_t>> codestreams,
                                 std::span<const uint32_t> sample_crcs);

/// CRC and size of a section's bytes, as the section table states them.
struct SectionSum {
  uint32_t crc = 0;
  uint64_t size = 0;

  void add(std::span<const uint8_t> bytes) {
    crc = crc32c(bytes, crc);
    size += bytes.size();
  }
};
using SectionSums = std::array<SectionSum, 5>;  ///< TOP, ROOT, GROUP, TILE, RIG

/// `header` with its section table.
StreamHeader with_sections(const StreamHeader& header, const SectionSums& sections);

/// The whole file; `header` without its section table, `index` finished, `rig` the section RIG
/// where `header` has camera_rig.
std::vector<uint8_t> assemble_stream(const StreamHeader& header, const std::vector<uint8_t>& top,
                                     const IndexWriter& index, std::span<const uint8_t> rig = {});

}  // namespace hmlfc
