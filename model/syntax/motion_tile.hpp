// The record of a motion tile of a predictive image (MOT-3, MOT-4).
#pragma once

#include <array>
#include <cstdint>

#include <hmlfc/error.hpp>
#include <hmlfc/format.hpp>

#include "arithmetic/levels.hpp"
#include "syntax/field_cursor.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {

inline constexpr unsigned kMaxPaletteEntries = 8;
inline constexpr unsigned kMaxExplicitBits = 12;

/// What a motion block can choose (MOT-5); 2 to 9 are the neighbours in the order of the
/// specification.
enum class MotionChoice : unsigned {
  kNone = 0,
  kOwnDisparity = 1,
  kLastNeighbour = 9,
  kExplicitDisparity = 10,
  kExplicitVector = 11,
};

/// One palette entry (MOT-3).
struct PaletteEntry {
  unsigned reference_set = 0;  ///< [0, 7]
  unsigned choice = 0;         ///< [0, 15] as read; [0, 11] where a block uses it
  bool negative = false;       ///< sign -
  int32_t explicit_x = 0;      ///< [-2048, 2047]
  int32_t explicit_y = 0;

  bool has_motion() const { return !is(MotionChoice::kNone); }
  bool is(MotionChoice what) const { return choice == static_cast<unsigned>(what); }
  /// Whether its vectors follow from a disparity that a reference image holds.
  bool shares_disparity() const {
    return has_motion() && choice <= static_cast<unsigned>(MotionChoice::kLastNeighbour);
  }
};

/// What a motion tile's place says about its record.
struct MotionContext {
  uint32_t width = 0;   ///< samples of the tile in the plane, [1, S]
  uint32_t height = 0;  ///< [1, S]
  unsigned tile_log2 = 5;
  unsigned block_size = 4;      ///< B
  bool two_references = false;  ///< entries have reference_set
  bool disparities = false;     ///< choices 1 to 10 are there
  bool keyed = false;           ///< entries have no sign
};

/// The context of motion tile `place`.
MotionContext motion_context(const StreamView& stream, const MotionTilePlace& place);

/// Everything of a record but the indices, which are there: they begin at bit indices_at.
struct MotionHead {
  unsigned block_log2 = 2;  ///< log2 of m, [2, 7]
  unsigned entries = 1;     ///< [1, 8]
  std::array<PaletteEntry, kMaxPaletteEntries> palette{};
  uint32_t columns = 1;  ///< motion blocks at least partly in the plane
  uint32_t rows = 1;
  Levels levels;  ///< of the indices
  uint64_t indices_at = 0;

  uint64_t blocks() const { return uint64_t{columns} * rows; }
};

/// Reads the record at the cursor up to its indices. Errors: tile_overrun, also where an index is
/// not there, and bad_mode.
Result<MotionHead> read_motion_head(FieldCursor& cursor, const MotionContext& context);

/// What every block of an empty motion tile has (MOT-4): one motion block of S x S samples.
MotionHead empty_motion_head(const MotionContext& context);

/// Whether a block may use `entry` (MOT-3).
bool is_usable(const PaletteEntry& entry, const MotionContext& context);

/// The entry of index `index`; bad_mode where no block may use it (MOT-3). `cursor` says where.
Result<PaletteEntry> palette_entry(const FieldCursor& cursor, const MotionHead& head,
                                   const MotionContext& context, uint32_t index);

/// The entry of the motion block that holds sample (x, y) of the tile, found by position. Errors:
/// bad_mode.
Result<PaletteEntry> read_motion_entry(const FieldCursor& cursor, const MotionHead& head,
                                       const MotionContext& context, uint32_t x, uint32_t y);

}  // namespace hmlfc
