// Records of motion tiles: the palette and indices of a predictive image (MOT-3 to MOT-5), the
// disparities of a reference image (MOT-6).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <hmlfc/error.hpp>
#include <hmlfc/format.hpp>

#include "arithmetic/bise.hpp"
#include "arithmetic/rounding.hpp"
#include "bits/bit_string.hpp"
#include "syntax/field_cursor.hpp"
#include "syntax/stream_view.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {

/// Values of a palette entry's choice (MOT-5).
inline constexpr uint8_t kChoiceNone = 0;
inline constexpr uint8_t kChoiceOwn = 1;
inline constexpr uint8_t kFirstNeighbour = 2;
inline constexpr uint8_t kLastNeighbour = 9;
inline constexpr uint8_t kChoiceDisparity = 10;
inline constexpr uint8_t kChoiceVector = 11;

/// Offset of the grid block of choices 1 to 9 in columns and rows (MOT-5); entry 0 is not used.
inline constexpr std::array<std::array<int32_t, 2>, 10> kChoiceMoves{
    {{0, 0}, {0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

inline constexpr size_t kMaxPaletteEntries = 8;
inline constexpr unsigned kMaxExplicitBits = 12;

/// One palette entry (MOT-3).
struct PaletteEntry {
  uint8_t reference_set = 0;  ///< [0, 7]
  uint8_t choice = 0;         ///< [0, 15] as read; [0, 11] where a block uses it
  bool negative = false;      ///< sign -
  int16_t explicit_x = 0;     ///< [-2048, 2047], with choices 10 and 11
  int16_t explicit_y = 0;     ///< [-2048, 2047], with choice 11

  bool has_motion() const { return choice != kChoiceNone; }
  /// Whether its vectors follow from a disparity that a reference image holds.
  bool shares_disparity() const { return has_motion() && choice <= kLastNeighbour; }

  friend bool operator==(const PaletteEntry&, const PaletteEntry&) = default;
};

/// Facts about a motion tile's record that follow from its place.
struct MotionContext {
  uint32_t width = 0;   ///< samples of the tile in the plane, [1, S]
  uint32_t height = 0;  ///< [1, S]
  unsigned tile_log2 = 5;
  unsigned block_size = 4;      ///< B
  bool two_references = false;  ///< entries have reference_set
  bool disparities = false;     ///< choices 1 to 10 are there
  bool keyed = false;           ///< entries have no sign
};

/// The context of motion tile `place` of a predictive image.
MotionContext motion_context(const StreamView& stream, const MotionTilePlace& place);

/// A record without its indices, which begin at bit indices_at and are complete.
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
/// missing, and bad_mode.
Result<MotionHead> read_motion_head(FieldCursor& cursor, const MotionContext& context);

/// Returns what every block of an empty motion tile has (MOT-4): one motion block of S x S samples.
MotionHead empty_motion_head(const MotionContext& context);

/// Whether a block may use `entry` (MOT-3).
bool is_usable(const PaletteEntry& entry, const MotionContext& context);

/// The entry of the motion block that holds sample (x, y) of the tile, found by position. Errors:
/// bad_mode where no block may use it.
Result<PaletteEntry> read_motion_entry(const FieldCursor& cursor, const MotionHead& head,
                                       const MotionContext& context, uint32_t x, uint32_t y);

/// Which fields a palette entry has (MOT-3).
struct PaletteFields {
  bool reference_set = true;  ///< with two_references
  bool sign = false;          ///< at levels that are not keyed
};

/// Bits of a palette entry with a choice below 10.
constexpr unsigned palette_entry_bits(const PaletteFields& fields) {
  return 4u + (fields.reference_set ? 3u : 0u) + (fields.sign ? 1u : 0u);
}

/// The least explicit_bits with which `entry` can be written (MOT-3), in [0, 12].
unsigned explicit_bits(const PaletteEntry& entry);

/// Bits of motion_block, palette_size and explicit_bits.
inline constexpr unsigned kMotionHeadBits = 9;

/// All fields of a record (MOT-3).
struct MotionTileFields {
  unsigned block_log2 = 2;     ///< log2 of m, [2, 5]
  unsigned explicit_bits = 0;  ///< [0, 15]
  std::vector<PaletteEntry> palette;
  SequenceFields indices;
};

/// Appends all fields of the record.
void put_motion_fields(BitWriter& writer, const MotionTileFields& tile,
                       const PaletteFields& fields);

/// Decision of an encoder about a motion tile of a predictive image; the default where `empty`.
struct MotionTileCode {
  bool empty = true;
  unsigned block_log2 = 0;  ///< [2, 5]; the tile's own where empty
  std::vector<PaletteEntry> palette;
  std::vector<uint8_t> indices;  ///< of the motion blocks in the plane, row by row
};

/// The record of `tile`; empty for an empty tile.
std::vector<uint8_t> write_motion_tile(const MotionTileCode& tile, const PaletteFields& fields);

/// Largest level code of disparities: that of 1024 levels.
inline constexpr unsigned kMaxDisparityCode = 27;

/// The grid blocks of one motion tile that lie at least partly in the plane.
struct DisparityContext {
  uint32_t columns = 1;  ///< [1, 32]
  uint32_t rows = 1;

  uint64_t blocks() const { return uint64_t{columns} * rows; }
};

/// The context of motion tile `place` of a reference image; the stream has shared_disparity.
DisparityContext disparity_context(const StreamView& stream, const MotionTilePlace& place);

/// A record without its values, which begin at bit values_at and are complete.
struct DisparityHead {
  int32_t min_disparity = 0;  ///< [-4096, 4095]
  Levels levels;
  uint64_t values_at = 0;
};

/// Reads the record at the cursor up to its values. Errors: tile_overrun, also where a value is
/// missing, and bad_levels.
Result<DisparityHead> read_disparity_head(FieldCursor& cursor, const DisparityContext& context);

/// The disparity of grid block (gx, gy) of the tile, found by position; in [-4096, 4095]. Errors:
/// vector_range.
Result<int32_t> read_disparity(const FieldCursor& cursor, const DisparityHead& head,
                               const DisparityContext& context, uint32_t gx, uint32_t gy);

/// A grid block of a motion plane.
struct GridBlock {
  uint32_t gx = 0;
  uint32_t gy = 0;
  friend bool operator==(const GridBlock&, const GridBlock&) = default;
};

/// The grid block of 2^grid_log2 samples a side from which a block whose place is sample (x, y) of
/// motion plane `plane` takes its disparity with `choice` in [1, 9] (MOT-5, MOT-6).
///
/// Example: place (8, 0), grid of 4: choice 1 reads grid block (2, 0), choice 2, to the left,
/// (1, 0), choice 4, above, (2, 0).
inline GridBlock grid_block(uint32_t x, uint32_t y, unsigned choice, unsigned grid_log2,
                            const MotionPlaneShape& plane) {
  const auto moved = [&](uint32_t sample, int32_t steps, uint32_t size) {
    const auto last = static_cast<int32_t>((size - 1) >> grid_log2);
    const auto own = static_cast<int32_t>(sample >> grid_log2);
    return static_cast<uint32_t>(clamp(own + steps, 0, last));
  };
  const auto [dx, dy] = kChoiceMoves[choice];
  return {moved(x, dx, plane.width), moved(y, dy, plane.height)};
}

/// The disparities of one reference group, one for each grid block, row by row (MOT-6).
struct DisparityGrid {
  uint32_t blocks_x = 0;
  uint32_t blocks_y = 0;
  std::vector<int16_t> values;

  int16_t at(uint32_t x, uint32_t y) const { return values[size_t{y} * blocks_x + x]; }
};

/// Appends all fields of a record of disparities: `values` above min_disparity, which lies in
/// [-4096, 4095].
void put_disparity_fields(BitWriter& writer, int32_t min_disparity, const SequenceFields& values);

/// The record that holds `values`, in [-4096, 4095] and at most 1023 apart, row by row; empty where
/// all are 0.
std::vector<uint8_t> write_disparity_tile(std::span<const int16_t> values);

}  // namespace hmlfc
