// The records of a stream, to make seeds of.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "syntax/stream_view.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc::fuzz {

/// Records of one stream that become seeds, at most.
inline constexpr size_t kMaxRecords = 12;

/// The stream in `file`, without key images read; nothing where it does not open.
std::optional<StreamView> open_view(std::span<const uint8_t> file);

/// Calls `take` with the first block of every tile of every image that is not a key image.
void for_each_tile(const StreamView& stream, const std::function<void(const BlockSite&)>& take);

/// Calls `take` with every motion tile of the images that are reference images, or are not.
void for_each_motion_tile(const StreamView& stream, bool references,
                          const std::function<void(const MotionTilePlace&)>& take);

}  // namespace hmlfc::fuzz
