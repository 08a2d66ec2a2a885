// The records of a stream, as sources of seeds.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "syntax/stream_view.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc::fuzz {

/// The most records of a stream that become seeds.
inline constexpr size_t kMaxRecords = 12;

/// The stream in `file`, with no key image decoded; nothing if it does not open.
std::optional<StreamView> open_view(std::span<const uint8_t> file);

/// Calls `take` with the first block of every tile of every image that is not a key image.
void for_each_tile(const StreamView& stream, const std::function<void(const BlockSite&)>& take);

/// Calls `take` with every motion tile of the images that are reference images, or of the others.
void for_each_motion_tile(const StreamView& stream, bool references,
                          const std::function<void(const MotionTilePlace&)>& take);

}  // namespace hmlfc::fuzz
