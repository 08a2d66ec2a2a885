// Writing the records of motion tiles (MOT-3, MOT-6).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bits/bit_writer.hpp"
#include "syntax/motion_code.hpp"
#include "syntax/tile_fields.hpp"

namespace hmlfc {

/// Which fields a palette entry has (MOT-3).
struct PaletteFields {
  bool reference_set = true;  ///< with two_references
  bool sign = false;          ///< at levels that are not keyed
};

/// Bits of a palette entry with a choice below 10.
constexpr unsigned palette_entry_bits(const PaletteFields& fields) {
  return 4u + (fields.reference_set ? 3u : 0u) + (fields.sign ? 1u : 0u);
}

/// Bits of motion_block, palette_size and explicit_bits.
inline constexpr unsigned kMotionHeadBits = 9;

/// A record of a motion tile of a predictive image (MOT-3).
struct MotionTileFields {
  unsigned block_log2 = 2;     ///< log2 of m, [2, 5]
  unsigned explicit_bits = 0;  ///< [0, 15]
  std::vector<MotionSymbol> palette;
  SequenceFields indices;
};

/// Appends all fields of the record.
void put_motion_fields(BitWriter& writer, const MotionTileFields& tile,
                       const PaletteFields& fields);

/// The record of a motion tile of a predictive image; empty for an empty tile.
std::vector<uint8_t> write_motion_tile(const MotionTileCode& tile, const PaletteFields& fields);

/// Appends all fields of a record of disparities (MOT-6): `values` above min_disparity, in
/// [-4096, 4095].
void put_disparity_fields(BitWriter& writer, int32_t min_disparity, const SequenceFields& values);

/// The record that holds `values`, in [-4096, 4095] and at most 1023 apart, row by row; empty where
/// all are 0.
std::vector<uint8_t> write_disparity_tile(std::span<const int16_t> values);

}  // namespace hmlfc
