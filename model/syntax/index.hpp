// The index: from a tile number to its record (IDX-2 to IDX-7).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <hmlfc/error.hpp>
#include <hmlfc/trace.hpp>

#include "bits/bit_string.hpp"
#include "syntax/probe.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc {

/// Tiles of a tile group, and tile groups of a root entry (IDX-3, IDX-4).
inline constexpr uint64_t kGroupTiles = 64;
inline constexpr uint64_t kRootEntryBytes = 16;
inline constexpr uint64_t kGroupRecordBytes = 16;
inline constexpr unsigned kDataOffsetBits = 48;
inline constexpr unsigned kMaxOffsetBits = 32;

/// Checks the sizes of ROOT and GROUP (IDX-4, IDX-5): bad_section_size.
Result<void> check_index_sizes(const StreamView& stream);

/// Bytes [begin, end) of the TILE section; begin < end <= size of the section.
struct TileExtent {
  uint64_t begin = 0;
  uint64_t end = 0;
};

/// The place of the record of tile `tile` in [0, tile_count() - 1]; nothing where the tile is empty
/// (IDX-7). Three dependent reads at most; that of the record is the fourth. Errors:
/// bad_root_entry, bad_group_record, bad_tile_offset; bus_error where bytes cannot be read.
Result<std::optional<TileExtent>> find_tile(const StreamView& stream, uint64_t tile,
                                            const Probe& probe);

/// The number of the first tile in [begin, end), end <= tile_count(), that is not empty, or `end`.
/// The time follows the bytes of ROOT and GROUP that serve them, not the number of tiles. Errors:
/// those of find_tile for a tile up to the one found.
Result<uint64_t> next_tile(const StreamView& stream, uint64_t begin, uint64_t end);

/// The record of one tile.
struct TileRecord {
  BitString bits;
  uint64_t file_bit = 0;  ///< address of its first bit from the start of the file
};

/// The record of the tile that holds block `site`, which exists and is not in a key image; nothing
/// where the tile is empty (IDX-7). Errors: those of find_tile.
Result<std::optional<TileRecord>> find_record(const StreamView& stream, const BlockSite& site,
                                              const Probe& probe);

/// The record of motion tile `place`, which exists; nothing where it is empty. Errors: those of
/// find_tile.
Result<std::optional<TileRecord>> find_motion_record(const StreamView& stream,
                                                     const MotionTilePlace& place,
                                                     const Probe& probe);

/// Choices that IDX-4 to IDX-6 leave open; the default takes the fewest bytes.
struct IndexLayout {
  unsigned least_offset_bits = 1;  ///< [1, 32]
  unsigned spare_records = 0;      ///< group records before the first in use
  unsigned spare_bytes = 0;        ///< bytes of TILE before the data of each group
  bool records_of_empty = false;   ///< empty tile groups have a record, of mask 0
};

/// Collects the tile records of a stream in the order of their tile numbers.
class IndexWriter {
 public:
  explicit IndexWriter(const IndexLayout& layout = {});

  /// Appends tile number 0, 1, 2, ...; an empty record stands for an empty tile.
  void add(std::span<const uint8_t> record);

  /// The bytes of `tiles` so far, which are taken out: later ones follow them in the section.
  std::vector<uint8_t> take_tiles();

  /// Ends the last tile group. Afterwards the sections are complete.
  void finish();

  std::vector<uint8_t> root;
  std::vector<uint8_t> groups;
  std::vector<uint8_t> tiles;

 private:
  void flush_group();
  void flush_root_entry();

  IndexLayout layout_;
  uint64_t next_tile_ = 0;
  uint64_t tiles_taken_ = 0;  // bytes
  uint64_t groups_done_ = 0;

  uint64_t tile_mask_ = 0;
  std::vector<uint64_t> ends_;
  std::vector<uint8_t> records_;

  uint64_t group_mask_ = 0;
  uint64_t first_record_ = 0;
};

}  // namespace hmlfc
