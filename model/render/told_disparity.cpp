#include "render/told_disparity.hpp"

#include <algorithm>

#include "arithmetic/motion.hpp"

namespace hmlfc {
namespace {

// Whether the reference group of `image` has other images: if so, one of them is its neighbour.
bool has_company(const Geometry& geometry, int level, ImagePos image) {
  const LevelShape& shape = geometry.level(level);
  const ImagePos group = geometry.group_of(level, image);
  const auto is_member = [&](uint32_t row, uint32_t col) {
    return row < shape.rows && col < shape.cols && geometry.group_of(level, {row, col}) == group;
  };
  return is_member(image.row + 1, image.col) || is_member(image.row, image.col + 1) ||
         (image.row > 0 && is_member(image.row - 1, image.col)) ||
         (image.col > 0 && is_member(image.row, image.col - 1));
}

DisparitySource source_of(const StreamView& stream, int level, ImagePos image) {
  if (!stream.geometry.is_reference(level, image)) {
    return stream.header.has(Feature::kMotionTiles) ? DisparitySource::kMotionTiles
                                                    : DisparitySource::kVectors;
  }
  const bool shared =
      stream.header.has(Feature::kSharedDisparity) && has_company(stream.geometry, level, image);
  return shared ? DisparitySource::kShared : DisparitySource::kNone;
}

// kc or kr of GEO-4.
int32_t views_apart(uint32_t cluster, int level) {
  uint32_t apart = 1;
  for (int l = 0; l < level; ++l) apart = std::min(apart * cluster, kMaxGrid);
  return static_cast<int32_t>(apart);
}

}  // namespace

ToldDisparity::ToldDisparity(const StreamView& stream, int level, ImagePos image)
    : stream_(stream),
      level_(level),
      image_(image),
      source_(source_of(stream, level, image)),
      cols_apart_(views_apart(stream.header.cluster_cols, level)),
      rows_apart_(views_apart(stream.header.cluster_rows, level)) {}

// GEO-6 for levels that are not keyed.
BlockDisparity ToldDisparity::with(int16_t disparity, uint8_t confidence) const {
  return {disparity, stream_.geometry.level(level_).keyed ? confidence : kUncertain};
}

BlockDisparity ToldDisparity::of_disparity(int32_t d, uint8_t confidence) const {
  return with(scaled_disparity(d, stream_.header.disparity_precision, cols_apart_), confidence);
}

BlockDisparity ToldDisparity::shared(int32_t d) const { return of_disparity(d, kSharedDisparity); }

std::optional<BlockDisparity> ToldDisparity::of_entry(const PaletteEntry& entry,
                                                      int32_t disparity) const {
  if (!entry.has_motion()) return std::nullopt;
  if (entry.shares_disparity()) return shared(disparity);
  if (entry.choice == kChoiceDisparity) {
    return of_disparity(entry.explicit_x, kOwnDisparity);
  }
  const MotionVector vector =
      explicit_vector(entry.explicit_x, entry.explicit_y, vector_rules(stream_.header));
  const int32_t eighths = 1 << (3 - stream_.header.vector_precision);
  const uint8_t first = references_of_set(entry.reference_set).reference[0];
  return along({vector.x * eighths, vector.y * eighths},
               reference_images(stream_.geometry, level_, image_)[first]);
}

BlockDisparity ToldDisparity::of_vector(int32_t dx, int32_t dy) const {
  return along({8 * dx, 8 * dy}, stream_.geometry.reference_of(level_, image_));
}

// GEO-5 and GEO-6.
BlockDisparity ToldDisparity::along(const Span& eighths, ImagePos reference) const {
  const int32_t pitch = stream_.header.row_scale == 0 ? 16 : stream_.header.row_scale;
  const Span baseline{16 * cols_apart_ * col_offset(reference, image_),
                      pitch * rows_apart_ * row_offset(reference, image_)};
  return with(vector_disparity(eighths, baseline),
              is_along(eighths, baseline) ? kOwnDisparity : kUncertain);
}

}  // namespace hmlfc
