// Every check that is made when a stream is opened (FIL-8).
#pragma once

#include <span>

#include <hmlfc/decoder.hpp>
#include <hmlfc/error.hpp>

#include "syntax/stream_view.hpp"

namespace hmlfc {

/// The stream in `file`, checked.
Result<StreamView> open_stream(std::span<const uint8_t> file, const OpenOptions& options);

/// Access to the stream of a Decoder, for the other parts of this project.
struct DecoderAccess {
  /// The stream; it lives as long as the decoder, also when the decoder is moved.
  static const StreamView& stream(const Decoder& decoder);
};

}  // namespace hmlfc
