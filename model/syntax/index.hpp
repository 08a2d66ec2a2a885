// The index: from a tile number to the place of its record (IDX-4 to IDX-7).
#pragma once

#include <cstdint>
#include <optional>

#include <hmlfc/error.hpp>

#include "syntax/probe.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc {

inline constexpr uint64_t kRootEntryBytes = 16;
inline constexpr uint64_t kGroupRecordBytes = 16;
inline constexpr unsigned kDataOffsetBits = 48;
inline constexpr unsigned kMaxEndBits = 32;

/// Bytes [begin, end) of the TILE section; begin < end <= size of the section.
struct TileExtent {
  uint64_t begin = 0;
  uint64_t end = 0;
};

/// Checks the sizes of ROOT and GROUP (IDX-4, IDX-5): bad_section_size.
Result<void> check_index_sizes(const StreamView& stream);

/// Finds the record of tile `tile` in [0, tile_count() - 1]; nothing where the tile is empty
/// (IDX-7). Four dependent reads at most. Errors: bad_root_entry, bad_group_record,
/// bad_tile_offset.
Result<std::optional<TileExtent>> find_tile(const StreamView& stream, uint64_t tile,
                                            const Probe& probe);

}  // namespace hmlfc
