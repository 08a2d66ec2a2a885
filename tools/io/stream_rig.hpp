// The rig that a stream gets, and the rig that it has.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <hmlfc/byte_source.hpp>
#include <hmlfc/format.hpp>
#include <hmlfc/rig.hpp>

#include "io/rig_files.hpp"
#include "io/rig_text.hpp"

namespace hmlfc::io {

/// The rig that a stream gets.
struct ChosenRig {
  Rig rig;
  bool from_names = false;  ///< y grows with the rows; else it is what a file says
};

/// What rig_beside() finds, else what rig_of_names() does. Errors: theirs.
IoResult<std::optional<ChosenRig>> rig_of_views(const ViewList& views,
                                                const LightFieldShape& shape);

/// The most bytes by which stream_with_rig() makes a stream longer.
uint64_t most_rig_bytes(const ChosenRig& rig);

/// The section RIG of a stream with `header`. Where row_scale is negative, its rows go against the
/// pixels' y (CAM-2), and y of positions from file names with them.
std::string rig_section(const StreamHeader& header, const ChosenRig& rig);

/// The stream `bytes`, of profile extended, with `rig`.
std::vector<uint8_t> stream_with_rig(std::span<const uint8_t> bytes, const ChosenRig& rig);

/// What section RIG says, and its text.
struct FoundRig {
  Rig rig;
  std::string text;
};

/// What is found, or what is wrong with it; nothing without a section RIG.
using MaybeRig = std::optional<tl::expected<FoundRig, std::string>>;

/// The rig of the stream with `header` in `source`. Error: bus_error, where it cannot be loaded.
Result<MaybeRig> rig_in_stream(ByteSource& source, const StreamHeader& header);

}  // namespace hmlfc::io
