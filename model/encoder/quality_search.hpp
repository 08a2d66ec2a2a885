// The search for the quality of a target PSNR (profile extended).
#pragma once

#include <hmlfc/encoder.hpp>

namespace hmlfc {

/// Encodes with the lowest quality, in quarters, whose PSNR over RGB is at least `target_db` as far
/// as PSNR rises with quality; at quality 100 if none reaches it.
tl::expected<EncodedStream, EncodeError> search_quality(const LightField& light_field,
                                                        const EncodeParams& params,
                                                        double target_db, const Progress& progress);

}  // namespace hmlfc
