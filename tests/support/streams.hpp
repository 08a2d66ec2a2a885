// Streams for tests: headers with any value in any field, sections put together as they are, and
// streams taken apart into records.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include <hmlfc/decoder.hpp>

#include "syntax/geometry.hpp"
#include "vectors/random.hpp"

namespace hmlfc::test {

using Bytes = std::vector<uint8_t>;

/// A number in [lo, hi].
int draw(std::mt19937& random, int lo, int hi);

/// Any block of any view.
BlockAddress draw_block(vectors::Random& random, const Decoder& decoder);

/// Replaces the `size` bytes at `offset` by `value`, little-endian.
void patch(Bytes& bytes, size_t offset, unsigned size, uint64_t value);

/// Writes header_crc where the field header_bytes says, if that is in the file.
void seal(Bytes& file);

/// A valid header of the given height: 5 x 7 views of 100 x 60, window 16, 2 x 3 clusters, level l
/// with reference groups of (l + 1) x (l + 2).
StreamHeader some_header(int tree_height);

/// A valid header of profile extended with all its tools: six views of 40 x 40 in one row, groups
/// of 1 x 3 at level 0 and of one image above; vectors in half samples, disparities in quarters,
/// grid blocks and motion blocks of 32 x 32.
StreamHeader row_of_views(int tree_height);

/// The contents of TOP, ROOT, GROUP and TILE.
using SectionBytes = std::array<Bytes, 4>;

/// A whole file: `header` with the section table of `sections`, then the sections, with camera_rig
/// first `rig`.
Bytes file_of(StreamHeader header, const SectionBytes& sections, const Bytes& rig = {});

/// A valid stream with this header: random key images, and records of any fields (field_stream).
Bytes drawn_stream(const StreamHeader& header, uint64_t seed);

/// A stream as its records, to be changed one by one.
struct StreamParts {
  StreamHeader header;
  Geometry geometry;
  Bytes top;
  std::vector<Bytes> records;  ///< by tile number; empty for an empty tile

  /// All tiles are empty, all samples of key images 0.
  explicit StreamParts(const StreamHeader& header);

  /// The parts of `file`, which is valid.
  explicit StreamParts(const Bytes& file);

  /// The record of a tile of an image at `level`.
  Bytes& tile(int level, ImagePos image, Plane plane, uint32_t tx = 0, uint32_t ty = 0);

  /// The record of a motion tile of motion plane `m`.
  Bytes& motion_tile(int level, ImagePos image, size_t m = 0, uint32_t tx = 0, uint32_t ty = 0);

  Bytes file() const;
};

}  // namespace hmlfc::test
