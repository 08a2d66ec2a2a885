// The key images that a view is decoded from.
#pragma once

#include <compare>
#include <cstdint>
#include <set>

#include <hmlfc/format.hpp>

namespace hmlfc {

/// A key image in the grid of its level.
struct KeyImage {
  int level = 0;
  uint32_t row = 0;
  uint32_t col = 0;

  friend auto operator<=>(const KeyImage&, const KeyImage&) = default;
};

/// The key images that view `view` is decoded from, down to `stop_level`: its own, those of its
/// reference images and of their ancestors (DEC-1, DEC-4). `header` has passed parse_header.
std::set<KeyImage> key_images_of(const StreamHeader& header, ViewPos view, int stop_level);

}  // namespace hmlfc
