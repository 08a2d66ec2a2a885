// JPEG 2000 codestreams of one plane (KEY-2, KEY-4), by OpenJPEG.
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

/// That of plane `plane` where views have `depth` bits (KEY-2).
constexpr SamplePrecision precision_of(Plane plane, int depth) {
  const bool chroma = plane != Plane::kY;
  return {depth + (chroma ? 1 : 0), chroma};
}

/// How a codestream is coded, as far as KEY-2 leaves it free.
struct CodestreamOptions {
  /// About what coding passes that are cut off leave (EXT-6); 0: lossless.
  double mean_squared_error = 0;
  unsigned style = 0;        ///< of code-blocks: bits 0..5 of COD
  unsigned layers = 1;       ///< [1, 20]; each is `layer_db` better than the one before
  float layer_db = 6;        ///< about
  unsigned progression = 0;  ///< of COD, [0, 4]
  bool sop = false;          ///< SOP marker segments before packets
  bool eph = false;          ///< EPH markers after packet headers
  /// Of code-blocks: powers of two in [4, 1024], whose product is at most 4096.
  unsigned block_width = 64;
  unsigned block_height = 64;
  /// [0, 32], at most one for each halving of the smaller side. None: these, but at most 5.
  std::optional<int> decompositions;
  /// Precincts are stated as 2^n x 2^n samples: n in [1, 15], of which KEY-2 allows 15; 0: they are
  /// not stated.
  unsigned precinct_log2 = 0;
};

/// Whether `codestream` has the markers that KEY-2 asks for (ISO/IEC 15444-1, annex A), for a plane
/// of `width` x `height` samples with `precision`. The memory that decoding such a codestream takes
/// is proportional to its samples and its bytes, but for 20 MiB.
bool has_key_image_head(std::span<const uint8_t> codestream, uint32_t width, uint32_t height,
                        SamplePrecision precision);

/// The code-blocks of such a codestream, of 4 x 4 to 64 x 64 samples or as large in another shape:
/// at most a sixteenth of the samples, and a few more at the edges of subbands.
uint64_t code_blocks_of(std::span<const uint8_t> codestream, uint32_t width, uint32_t height);

/// The samples of a codestream that has_key_image_head has accepted for this size, clamped to the
/// interval of its precision (KEY-4); coding passes may be missing (EXT-6). `layers`: the first
/// that are decoded, 0 for all. Nothing where its packets cannot be decoded. Throws std::bad_alloc
/// where memory runs out.
std::optional<SamplePlane> decode_jpeg2000(std::span<const uint8_t> codestream, uint32_t width,
                                           uint32_t height, unsigned layers = 0);

/// Codes `plane` with the reversible 5/3 transform. The bytes are the same on every machine and for
/// any number of threads. Nothing where OpenJPEG fails, which means it is out of memory.
std::optional<std::vector<uint8_t>> encode_jpeg2000(const SamplePlane& plane,
                                                    SamplePrecision precision,
                                                    const CodestreamOptions& options = {});

}  // namespace hmlfc
