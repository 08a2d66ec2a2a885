// JPEG 2000 codestreams of one plane (KEY-2), by OpenJPEG.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "decoder/sample_plane.hpp"

namespace hmlfc {
/// Precision of a plane's samples: `bits` in [1, 16], two's complement if `is_signed`.
struct SamplePrecision {
  int bits = 8;
  bool is_signed = false;
};

/// Decodes a complete codestream, whose packets may leave out coding passes (EXT-6), of one
/// component of `width` x `height` samples with `precision`. Nothing where it cannot be decoded or
/// has another shape, which is checked before samples are allocated.
std::optional<SamplePlane> decode_jpeg2000(std::span<const uint8_t> codestream, uint32_t width,
                                           uint32_t height, SamplePrecision precision);

/// Codes `plane` losslessly with the reversible 5/3 transform. The bytes are the same on every
/// machine and for any number of threads. Nothing where OpenJPEG fails, which means it is out of
/// memory.
std::optional<std::vector<uint8_t>> encode_jpeg2000(const SamplePlane& plane,
                                                    SamplePrecision precision);

/// The same with coding passes cut off (EXT-6) where the mean squared error stays about
/// `mean_squared_error` > 0.
std::optional<std::vector<uint8_t>> encode_jpeg2000_lossy(const SamplePlane& plane,
                                                          SamplePrecision precision,
                                                          double mean_squared_error);

/// Whether `codestream` has the head that KEY-2 asks for: one component and one tile of exactly
/// `width` x `height` samples at the origin, the reversible 5/3 transform, precincts of the
/// largest size, no marker segments but SIZ, COD, QCD and COM, and one tile-part, without segments
/// of its own, that ends at the EOC marker that ends the codestream (ISO/IEC 15444-1, annex A).
/// The memory that such a codestream needs is proportional to its samples.
bool has_key_image_head(std::span<const uint8_t> codestream, uint32_t width, uint32_t height);

}  // namespace hmlfc
