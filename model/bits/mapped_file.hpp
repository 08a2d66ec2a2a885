// Files mapped to memory for reading (POSIX).
#pragma once

#include <cstdint>
#include <span>

#include <tl/expected.hpp>

namespace hmlfc {

/// Why a file is not mapped.
struct MapFailure {
  const char* reason = "";  ///< what could not be done, a line without full stop
  int system_error = 0;     ///< errno, or 0 where it says nothing
};

/// The bytes of the regular file `path`, which must not be shortened meanwhile (the system would
/// kill the process); no bytes of an empty file. Errors: the file does not exist, cannot be read,
/// or is not a regular file.
tl::expected<std::span<const uint8_t>, MapFailure> map_file(const char* path);

/// Ends the mapping of what map_file gave.
void unmap_file(std::span<const uint8_t> bytes);

}  // namespace hmlfc
