// Every check that is made when a stream is opened (FIL-8).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/error.hpp>

#include "decoder/fast/part_loader.hpp"
#include "decoder/key_images.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc {

/// The stream in `source`, checked; a partial source must outlive it.
Result<StreamView> open_stream(ByteSource& source, const OpenOptions& options);

/// Opens a stream in memory.
inline Result<StreamView> open_stream(std::span<const uint8_t> file, const OpenOptions& options) {
  MemorySource source(file);
  return open_stream(source, options);
}

/// Functions that a Decoder offers to other parts of this project alone.
struct DecoderAccess {
  /// The stream; it lives as long as the decoder, also when the decoder is moved.
  static const StreamView& stream(const Decoder& decoder);

  /// Decoder::decode_rect. With `requests` not null, planes of key images that are not decoded yet
  /// are added to it in place of being decoded; if there are any, the samples have no meaning. An
  /// error then need not be the right one.
  static Result<std::vector<int16_t>> decode_rect(const Decoder& decoder, ViewPos view, Plane plane,
                                                  const Rect& rect, int stop_level,
                                                  KeyRequests* requests);

  /// Loads what decoding `parts` with their ancestors reads, where the source is partial: for
  /// requests of many parts, before decode_rect.
  static void load(const Decoder& decoder, std::span<const ImagePart> parts);

  /// Decodes the planes of `requests` on all threads of the caller's run_on_threads().
  static void decode_keys(const Decoder& decoder, std::span<const KeyRequests> requests);
};

}  // namespace hmlfc
