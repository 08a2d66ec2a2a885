#include "encoder/coding_params.hpp"

#include <algorithm>

#include "arithmetic/rounding.hpp"
#include "syntax/header.hpp"

namespace hmlfc {
namespace {

// The levels above the views until one image is left, at most `wanted`.
int useful_height(const LightFieldShape& shape, const EncodeParams& params, int wanted) {
  uint32_t rows = shape.rows;
  uint32_t cols = shape.cols;
  int height = 0;
  while (height < wanted && rows * cols > 1) {
    const uint32_t next_rows = ceil_div(rows, params.cluster_rows);
    const uint32_t next_cols = ceil_div(cols, params.cluster_cols);
    if (next_rows == rows && next_cols == cols) break;
    rows = next_rows;
    cols = next_cols;
    ++height;
  }
  return height;
}

// Profile extended with all its tools; EncodeSession decides row_scale.
void use_extended_tools(const EncodeParams& params, StreamHeader& header) {
  header.profile = Profile::kExtended;
  const auto use = [&](Feature feature) { header.feature_flags |= feature_bit(feature); };
  use(Feature::kResidualStep);
  use(Feature::kBalancedGroups);
  if (!params.lossless) use(Feature::kLossyKeys);
  if (params.method == Method::kRlfc) return;
  use(Feature::kMotionTiles);
  use(Feature::kSubpelVectors);
  use(Feature::kSharedDisparity);
  use(Feature::kTwoReferences);
  header.vector_precision = 3;
  header.disparity_precision = 3;
  header.motion_tile_log2 = 6;
  header.disparity_grid_log2 =
      std::max(params.extended.disparity_grid == 4 ? 2u : 3u, header.block_log2);
  header.row_scale = 16;
}

}  // namespace

EncodeParams with_defaults(const EncodeParams& params) {
  EncodeParams complete = params;
  const bool main = params.profile == Profile::kMain;
  const bool tree = main || params.method == Method::kRlfc;
  if (!params.tree_height) complete.tree_height = tree ? 3 : 0;
  if (!params.window) complete.window = main ? 16 : 64;
  if (!params.chroma && params.lossless) complete.chroma = ChromaFormat::k444;
  if (!main) return complete;
  if (params.ref_rows == 0) complete.ref_rows = 8;
  if (params.ref_cols == 0) complete.ref_cols = 8;
  if (!complete.chroma) complete.chroma = ChromaFormat::k420;
  if (params.lossless) complete.main = {0, 0};
  return complete;
}

Result<StreamHeader> header_for(const LightFieldShape& shape, const EncodeParams& params) {
  const auto bad = [] { return fail(ErrorCode::kBadHeaderField, Section::kHeader, 0); };
  if (params.cluster_rows == 0 || params.cluster_cols == 0 || params.ref_rows == 0 ||
      params.ref_cols == 0 || params.ref_rows > 255 || params.ref_cols > 255) {
    return bad();
  }
  if (params.block_size != 2 && params.block_size != 4 && params.block_size != 8) return bad();
  StreamHeader header;
  header.rows = shape.rows;
  header.cols = shape.cols;
  header.width = shape.width;
  header.height = shape.height;
  header.depth = shape.depth;
  header.chroma_format = *params.chroma;
  header.block_log2 = params.block_size == 2 ? 1 : params.block_size == 4 ? 2 : 3;
  header.window = params.method == Method::kRlfc ? 0 : *params.window;
  header.cluster_rows = params.cluster_rows;
  header.cluster_cols = params.cluster_cols;
  header.tree_height =
      params.method == Method::kMc ? 0 : useful_height(shape, params, *params.tree_height);
  const LevelEntry motion{static_cast<uint8_t>(params.ref_rows),
                          static_cast<uint8_t>(params.ref_cols)};
  const LevelEntry lone{};
  header.levels.assign(static_cast<size_t>(header.tree_height) + 1,
                       params.method == Method::kRlfc ? lone : motion);
  // In profile main a tree's top level is all key images. At height 0 they would be all views.
  const bool lone_top = params.profile == Profile::kMain || header.tree_height > 0;
  if (params.method == Method::kHmlfc && lone_top) header.levels.back() = lone;
  if (params.profile == Profile::kExtended) use_extended_tools(params, header);
  if (auto ok = check_fields(header); !ok) return tl::unexpected(ok.error());
  return header;
}

const char* problem_of(const LightFieldShape& shape, const EncodeParams& params) {
  const EncodeParams complete = with_defaults(params);
  EncodeParams checked = complete;  // what is left to a trial passes any check
  checked.ref_rows = std::max(1u, complete.ref_rows);
  checked.ref_cols = std::max(1u, complete.ref_cols);
  checked.chroma = complete.chroma.value_or(ChromaFormat::k420);
  const double quality = params.extended.quality;
  if (!(quality >= lowest_quality(shape.depth) && quality <= kHighestQuality)) {
    return "the quality is outside [0, 132]; the least is -32 for samples of 10 bits, -64 for 12";
  }
  const unsigned grid = params.extended.disparity_grid;
  if (grid != 0 && grid != 4 && grid != 8) return kOutsideInterval;
  if (!header_for(shape, checked)) return kOutsideInterval;
  return nullptr;
}

}  // namespace hmlfc
