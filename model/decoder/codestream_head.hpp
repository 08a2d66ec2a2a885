// The head of a JPEG 2000 codestream, checked before a decoder allocates for what it declares.
#pragma once

#include <cstdint>
#include <span>

namespace hmlfc {

/// Whether `codestream` has the head that KEY-2 asks for: one component and one tile of exactly
/// `width` x `height` samples at the origin, the reversible 5/3 transform, precincts of the
/// greatest size, no marker segments but SIZ, COD, QCD and COM, and one tile-part, without segments
/// of its own, that ends at the EOC marker that ends the codestream (ISO/IEC 15444-1, annex A).
/// What a decoder needs for such a codestream is in proportion to its samples.
bool has_key_image_head(std::span<const uint8_t> codestream, uint32_t width, uint32_t height);

}  // namespace hmlfc
