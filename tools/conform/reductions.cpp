#include "conform/reductions.hpp"

#include <algorithm>
#include <iterator>

#include "decoder/jpeg2000.hpp"
#include "syntax/header.hpp"

namespace hmlfc::conform {
namespace {

SamplePlane cropped(const SamplePlane& plane, const PlaneShape& shape) {
  SamplePlane cut(shape.width, shape.height);
  for (uint32_t y = 0; y < cut.height; ++y) {
    std::ranges::copy(plane.row(y).first(cut.width), cut.row(y).begin());
  }
  return cut;
}

}  // namespace

std::optional<StreamParts> with_grid(const StreamParts& parts, uint32_t rows, uint32_t cols,
                                     const Decoder& decoder) {
  StreamParts smaller = parts;
  smaller.header.rows = rows;
  smaller.header.cols = cols;
  if (!add_missing_keys(smaller, decoder)) return std::nullopt;
  return smaller;
}

std::optional<StreamParts> with_size(const StreamParts& parts, uint32_t width, uint32_t height) {
  StreamParts smaller = parts;
  smaller.header.width = width;
  smaller.header.height = height;
  if (!check_fields(smaller.header)) return std::nullopt;
  const Geometry before(parts.header);
  const Geometry after(smaller.header);
  for (auto& [place, key] : smaller.keys) {
    const auto plane = static_cast<Plane>(place.plane);
    const PlaneShape& shape = before.plane(plane);
    const auto samples = decode_jpeg2000(key.codestream, shape.width, shape.height,
                                         key_precision(parts.header, place.plane));
    if (!samples) return std::nullopt;
    auto code = key_code(cropped(*samples, after.plane(plane)), parts.header, place.plane);
    if (!code) return std::nullopt;
    key = std::move(*code);
  }
  return smaller;
}

std::optional<StreamParts> without_top_level(const StreamParts& parts, const Decoder& decoder) {
  if (parts.header.tree_height == 0) return std::nullopt;
  StreamParts smaller = parts;
  --smaller.header.tree_height;
  smaller.header.levels.pop_back();
  if (!add_missing_keys(smaller, decoder)) return std::nullopt;
  return smaller;
}

StreamParts without_tiles(const StreamParts& parts, size_t begin, size_t end) {
  StreamParts smaller{parts.header, parts.keys, {}};
  size_t number = 0;
  for (const auto& tile : parts.tiles) {
    if (number < begin || number >= end) smaller.tiles.insert(tile);
    ++number;
  }
  return smaller;
}

}  // namespace hmlfc::conform
