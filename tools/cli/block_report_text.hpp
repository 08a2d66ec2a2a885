// A block's trace for people: what a decoder reads and computes, level by level.
#pragma once

#include <string>

#include "cli/block_trace.hpp"

namespace hmlfc::cli {

std::string to_text(const BlockReport& report);

}  // namespace hmlfc::cli
