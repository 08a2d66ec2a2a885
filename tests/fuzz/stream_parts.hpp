// Splits a stream into its parts and joins them again under a matching header.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <hmlfc/format.hpp>

namespace hmlfc::fuzz {

/// The header of a file up to its section table, and the sections.
struct StreamParts {
  std::vector<uint8_t> head;
  std::array<std::vector<uint8_t>, 4> sections;  ///< TOP, ROOT, GROUP, TILE
  std::optional<std::vector<uint8_t>> rig;       ///< RIG, where the flag camera_rig is set
};

/// The parts of `file`, split as its header says, whatever else is wrong; sections are cut at the
/// end of the file. Nothing if the file is shorter than a header.
std::optional<StreamParts> split(std::span<const uint8_t> file);

/// The file of `parts`, with correct section table, header_bytes and CRCs, except those of samples.
std::vector<uint8_t> join(const StreamParts& parts);

}  // namespace hmlfc::fuzz
