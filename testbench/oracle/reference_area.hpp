// The reference area of docs/decode_unit.md: the decoded reference images as the decode unit
// reads them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <hmlfc/error.hpp>

#include "decoder/golden/block_decoder.hpp"
#include "decoder/key_images.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc::tb {

inline constexpr unsigned kStripSamples = 64;
inline constexpr unsigned kStripBytes = 128;  ///< of a strip's place

/// The samples of a block that did not decode.
constexpr int32_t poison_of(ErrorCode error) { return static_cast<int32_t>(error) - (1 << 15); }

/// The samples of one strip: block after block, each row by row. A value below -2^15 + 32 stands
/// for an error (poison_of).
using StripSamples = std::array<int32_t, kStripSamples>;

/// Sets the field of `count` bits at `position` of a bit string (CNV-4).
void set_field(std::span<uint8_t> bytes, uint64_t position, unsigned count, uint64_t value);

/// Packs samples in [-2^13, 2^13 - 1], and blocks of errors, into a place, each quarter with the
/// least width that serves.
///
/// Example: 64 samples of 7 take four times 4 + 16 bits: width 0, base 7.
std::array<uint8_t, kStripBytes> pack_strip(const StripSamples& samples);

/// The bits that the fields of a strip take, at most 976.
unsigned strip_bits(std::span<const uint8_t> place);

/// One plane of one reference image in the area.
struct AreaPlane {
  int level = 0;
  ImagePos image;
  Plane plane = Plane::kY;
  uint64_t offset = 0;  ///< bytes from the start of the area
  uint64_t size = 0;    ///< bytes
};

/// Where everything lies in an area.
struct AreaLayout {
  std::vector<AreaPlane> planes;  ///< in the area's order
  uint64_t size = 0;              ///< bytes
};

/// The layout of the area of a stream with `geometry`.
AreaLayout area_layout(const Geometry& geometry);

/// Strips of a row of strips of a plane `width` samples wide with blocks of `block_size`.
///
/// Example: width 100 with blocks of 4: 25 blocks, 4 to a strip, 7 strips.
uint32_t strips_in_row(uint32_t width, unsigned block_size);

/// The area's bytes.
struct ReferenceArea {
  AreaLayout layout;
  std::vector<uint8_t> bytes;
};

/// The area of `stream`; blocks that do not decode are poisoned. Samples of planes that no block
/// refers to (levels that are not keyed and have groups of 1 x 1) are left 0.
ReferenceArea build_reference_area(const StreamView& stream, const KeyImages& keys,
                                   const HeldReferences& references);

}  // namespace hmlfc::tb
