// A stream taken apart and put together again with a header that fits.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <hmlfc/format.hpp>

namespace hmlfc::fuzz {

/// The header of a file up to its section table, and the four sections.
struct StreamParts {
  std::vector<uint8_t> head;
  std::array<std::vector<uint8_t>, 4> sections;  ///< TOP, ROOT, GROUP, TILE
};

/// The parts of `file`, cut where its header says so, whatever else is wrong; sections that lie
/// outside are cut short. Nothing where there is no room for a header.
std::optional<StreamParts> split(std::span<const uint8_t> file);

/// The file of `parts`: section table, header_bytes and every CRC but those of samples are right.
std::vector<uint8_t> join(const StreamParts& parts);

}  // namespace hmlfc::fuzz
