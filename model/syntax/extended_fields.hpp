// Feature flags and the header fields of profile extended (EXT-1, EXT-2).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <hmlfc/error.hpp>
#include <hmlfc/format.hpp>

namespace hmlfc {

/// Whether feature_flags has known bits alone, each with those that it needs, as the profile allows
/// (EXT-1).
bool has_valid_features(const StreamHeader& header);

/// Reads the fields of EXT-2 from `file`, which holds a whole header.
void load_extended_fields(std::span<const uint8_t> file, StreamHeader& header);

/// Checks the fields of EXT-2 against their intervals: bad_header_field. All are 0 in profile main.
Result<void> check_extended_fields(const StreamHeader& header);

/// Appends the fields of EXT-2 to the 35 bytes of the header before them.
void append_extended_fields(const StreamHeader& header, std::vector<uint8_t>& bytes);

}  // namespace hmlfc
