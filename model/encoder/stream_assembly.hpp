// Putting the parts of a stream together (FIL-1, KEY-1).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <hmlfc/format.hpp>

#include "syntax/index.hpp"

namespace hmlfc {

/// The TOP section: table and codestreams of the planes of all key images, in order, with the
/// CRC-32C of the samples of each.
std::vector<uint8_t> top_section(std::span<const std::vector<uint8_t>> codestreams,
                                 std::span<const uint32_t> sample_crcs);

/// The whole file; `header` without its section table, `index` finished, `rig` the section RIG
/// where `header` has camera_rig.
std::vector<uint8_t> assemble_stream(const StreamHeader& header, const std::vector<uint8_t>& top,
                                     const IndexWriter& index, std::span<const uint8_t> rig = {});

}  // namespace hmlfc
