// Ways to make a stream smaller, and the smallest one found that still makes a decoder fail.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <hmlfc/decoder.hpp>

#include "conform/stream_parts.hpp"
#include "io/io_error.hpp"

namespace hmlfc::conform {

/// The first `rows` x `cols` views. Images that become key images get the samples that `decoder`,
/// of the stream of `parts`, has for them. Nothing where one does not decode.
std::optional<StreamParts> with_grid(const StreamParts& parts, uint32_t rows, uint32_t cols,
                                     const Decoder& decoder);

/// The left upper `width` x `height` pixels of all views: key images are cut and coded anew.
/// Nothing where a key image does not decode.
std::optional<StreamParts> with_size(const StreamParts& parts, uint32_t width, uint32_t height);

/// Without the top level: the reference images of the level below become key images, as above.
/// Nothing where the tree has one level, or an image does not decode.
std::optional<StreamParts> without_top_level(const StreamParts& parts, const Decoder& decoder);

/// Without the tile records number `begin` to `end` - 1.
StreamParts without_tiles(const StreamParts& parts, size_t begin, size_t end);

/// Whether a valid stream still shows the failure.
using StillFails = std::function<bool(std::span<const uint8_t> stream)>;

struct Minimised {
  std::vector<uint8_t> stream;  ///< valid: the golden model decodes all of it
  unsigned trials = 0;          ///< streams that the decoder was run on
  unsigned steps = 0;           ///< reductions that were kept
};

/// Makes `stream`, which fails, smaller as long as it fails: fewer levels of the tree, views,
/// pixels and tiles, in turns until none of them helps or `max_trials` streams were tried. Every
/// stream that is tried decodes in the golden model. The result depends on the arguments alone.
/// Errors: the golden model does not decode `stream`, or it has more than 2^20 tiles.
io::IoResult<Minimised> minimise(std::span<const uint8_t> stream, const StillFails& still_fails,
                                 unsigned max_trials);

}  // namespace hmlfc::conform
