// A block's trace as JSON.
#pragma once

#include "cli/block_trace.hpp"
#include "cli/output.hpp"

namespace hmlfc::cli {

/// Keys: view, plane, block, levels[] {level, image, kind, state, fields[], reference_blocks[],
/// stages{}} from the top, cost. Fields are {section, byte, bit, bits, name, clause, value}, stages
/// {clause, values} with the values as rows of the block.
Json to_json(const BlockReport& report);

}  // namespace hmlfc::cli
