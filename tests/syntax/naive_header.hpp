// Headers and whole files written from the tables of FIL-1 to FIL-3, any value in any field.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <hmlfc/format.hpp>

namespace hmlfc::test {

using Bytes = std::vector<uint8_t>;

/// Replaces the `size` bytes at `offset` by `value`, little-endian.
void patch(Bytes& bytes, size_t offset, unsigned size, uint64_t value);

/// Writes header_crc where the field header_bytes says, if that is in the file.
void seal(Bytes& file);

/// The header as FIL-1 lays it out, sealed.
Bytes naive_header(const StreamHeader& header);

/// The contents of TOP, ROOT, GROUP and TILE.
using SectionBytes = std::array<Bytes, 4>;

/// A whole file: `header` with the section table of `sections`, then the sections.
Bytes naive_file(StreamHeader header, const SectionBytes& sections);

/// A valid header of the given height: 5 x 7 views of 100 x 60, window 16, 2 x 3 clusters, level l
/// with reference groups of (l + 1) x (l + 2).
StreamHeader some_header(int tree_height);

}  // namespace hmlfc::test
