// One light field being encoded in profile extended.
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/encoder.hpp>

#include "encoder/extended_level.hpp"

namespace hmlfc {

/// All parts of a stream.
struct ExtendedStream {
  StreamHeader header;
  std::vector<ExtendedImageCode> codes;
  CodedKeys keys;
  ErrorSums error;
};

/// Encodes at params.quality. `header` comes from header_for; its row_scale is chosen here.
ExtendedStream encode_extended(const LightField& light_field, const StreamHeader& header,
                               const EncodeParams& params, const EncodeObserver& observer);

/// The whole file; uses up `stream`.
std::vector<uint8_t> assemble_extended(ExtendedStream& stream);

}  // namespace hmlfc
