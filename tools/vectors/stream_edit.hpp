// Damages a stream in one named place (vectors/README.md, edits).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "vectors/json.hpp"

namespace hmlfc::vectors {

/// A field as bytes of the file.
struct ByteField {
  std::string_view name;
  size_t offset;
  size_t bytes;
};

/// The fields at fixed places: the tables of FIL-1 and EXT-2.
std::span<const ByteField> header_fields();

/// The little-endian number in `size` bytes, at most 8. Throws std::out_of_range.
uint64_t load_number(std::span<const uint8_t> bytes, uint64_t at, size_t size);

/// Applies one edit to `bytes`. `json` is one of
///   {"header": FIELD, "value": n}
///       a field of FIL-1 or EXT-2, or of the level entry at "level"
///   {"section": NAME, "entry": FIELD, "value": n}
///       type, crc, offset or size of a section entry
///   {"field": FIELD, "block": B, "value": n}
///       a field that is read for block B, at level "level" (0), its occurrence "nth" (0)
///   {"bytes": NAME, "at": n, "value": [...]}
///       bytes of a section
///   {"marker": m, "codestream": n, "at": k, "value": [...]}
///       bytes of a codestream of TOP, k bytes after the first byte of its first marker m
///       (65424: SOT)
///   {"splice": m, "codestream": n, "at": k, "remove": r, "insert": [...]}
///       r bytes of a codestream, at a place as above, replaced by others; sizes and offsets of TOP
///       and its table follow and, where the place lies in the tile-part, Psot
///   {"resize": NAME, "by": n}
///       zero bytes added at a section's end, or bytes cut off
///   {"cut": n}
///       the file's length; below 0, from the end
///   {"append": [...]}
///       bytes after the end of the file
/// For a named field, "add": n instead of "value" changes it by n.
/// Afterwards the CRCs of sections and header are corrected; with "mend": "header" that of the
/// header alone, with "mend": false none. A field that is stored with an offset (min_x) takes the
/// stored value. Throws TextError or std::out_of_range.
void edit_stream(std::vector<uint8_t>& bytes, const Json& json);

}  // namespace hmlfc::vectors
