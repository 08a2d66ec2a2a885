// Ways to make a stream smaller. Each result may or may not be a valid stream: who uses it asks a
// decoder.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <hmlfc/decoder.hpp>

#include "conform/stream_parts.hpp"

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

}  // namespace hmlfc::conform
