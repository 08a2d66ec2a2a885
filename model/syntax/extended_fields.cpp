#include "syntax/extended_fields.hpp"

#include <array>

namespace hmlfc {
namespace {

// Byte offsets of EXT-2.
constexpr size_t kAtVectorPrecision = 35;
constexpr size_t kAtDisparityPrecision = 36;
constexpr size_t kAtMotionTileLog2 = 37;
constexpr size_t kAtDisparityGridLog2 = 38;
constexpr size_t kAtRowScale = 39;

// Flags that mean something with motion tiles alone.
constexpr uint32_t kNeedMotionTiles =
    feature_bit(Feature::kSubpelVectors) | feature_bit(Feature::kSharedDisparity) |
    feature_bit(Feature::kTwoReferences) | feature_bit(Feature::kChromaMotion);

// A field whose tool is not used is 0.
template <class T>
bool valid(bool used, T value, T lo, T hi) {
  return used ? value >= lo && value <= hi : value == 0;
}

}  // namespace

bool has_valid_features(const StreamHeader& header) {
  if (header.profile == Profile::kMain) return header.feature_flags == 0;
  if ((header.feature_flags >> kFeatureCount) != 0) return false;
  return header.has(Feature::kMotionTiles) || (header.feature_flags & kNeedMotionTiles) == 0;
}

void load_extended_fields(std::span<const uint8_t> file, StreamHeader& header) {
  header.vector_precision = file[kAtVectorPrecision];
  header.disparity_precision = file[kAtDisparityPrecision];
  header.motion_tile_log2 = file[kAtMotionTileLog2];
  header.disparity_grid_log2 = file[kAtDisparityGridLog2];
  header.row_scale = static_cast<int8_t>(file[kAtRowScale]);
}

Result<void> check_extended_fields(const StreamHeader& h) {
  const auto bad = [](size_t at) { return fail(ErrorCode::kBadHeaderField, Section::kHeader, at); };
  const bool disparity = h.has(Feature::kSharedDisparity);
  if (!valid(h.has(Feature::kSubpelVectors), h.vector_precision, 1u, 3u)) {
    return bad(kAtVectorPrecision);
  }
  if (!valid(disparity, h.disparity_precision, h.vector_precision, 5u)) {
    return bad(kAtDisparityPrecision);
  }
  if (!valid(h.has(Feature::kMotionTiles), h.motion_tile_log2, 5u, 7u)) {
    return bad(kAtMotionTileLog2);
  }
  if (!valid(disparity, h.disparity_grid_log2, 2u, 5u)) return bad(kAtDisparityGridLog2);
  if (!valid(disparity, h.row_scale, -127, 127)) return bad(kAtRowScale);
  return {};
}

void append_extended_fields(const StreamHeader& header, std::vector<uint8_t>& bytes) {
  const std::array<uint8_t, 5> fields{
      static_cast<uint8_t>(header.vector_precision),
      static_cast<uint8_t>(header.disparity_precision),
      static_cast<uint8_t>(header.motion_tile_log2),
      static_cast<uint8_t>(header.disparity_grid_log2),
      static_cast<uint8_t>(header.row_scale),
  };
  bytes.insert(bytes.end(), fields.begin(), fields.end());
}

}  // namespace hmlfc
