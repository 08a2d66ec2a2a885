#include "encoder/encode_session.hpp"

#include <algorithm>
#include <new>

#include "arithmetic/rounding.hpp"
#include "bits/parallel.hpp"
#include "decoder/jpeg2000.hpp"
#include "decoder/key_images.hpp"
#include "encoder/stream_assembly.hpp"
#include "encoder/view_planes.hpp"
#include "syntax/header.hpp"
#include "syntax/index.hpp"

namespace hmlfc {
namespace {

// Levels above 0 until one image is left, `wanted` at most.
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

// Profile extended with all its tools; row_scale is chosen later.
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
  header.disparity_grid_log2 = std::max(3u, header.block_log2);
  header.row_scale = 16;
}

std::vector<ImagePos> key_positions(const Geometry& geometry) {
  const LevelShape& top = geometry.level(geometry.top());
  std::vector<ImagePos> positions;
  for (uint32_t row = 0; row < top.rows; ++row) {
    for (uint32_t col = 0; col < top.cols; ++col) {
      if (geometry.is_key(geometry.top(), {row, col})) positions.push_back({row, col});
    }
  }
  return positions;
}

}  // namespace

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
  header.chroma_format = params.chroma;
  header.block_log2 = params.block_size == 2 ? 1 : params.block_size == 4 ? 2 : 3;
  header.window = params.method == Method::kRlfc ? 0 : params.window;
  header.cluster_rows = params.cluster_rows;
  header.cluster_cols = params.cluster_cols;
  header.tree_height = params.method == Method::kMc || params.tree_height < 0
                           ? 0
                           : useful_height(shape, params, params.tree_height);
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

EncodeSession::EncodeSession(const LightField& light_field, const StreamHeader& header,
                             const EncodeParams& params)
    : light_field_(light_field),
      header_(header),
      params_(params),
      geometry_(header),
      originals_(build_rkv_tree(light_field, geometry_, header.cluster_rows, header.cluster_cols)),
      top_(write_top()) {}

// Table and codestreams of the key images (KEY-1 to KEY-3).
std::vector<uint8_t> EncodeSession::write_top() const {
  const std::vector<ImagePos> keys = key_positions(geometry_);
  std::vector<std::vector<uint8_t>> codestreams(keys.size() * kPlaneCount);
  std::vector<uint32_t> crcs(codestreams.size());
  parallel_for(keys.size(), [&](size_t k) {
    const ImagePlanes planes = geometry_.top() == 0
                                   ? view_planes(light_field_, geometry_, keys[k])
                                   : originals_.at(geometry_, geometry_.top(), keys[k]);
    for (const Plane plane : kPlanes) {
      const PlaneShape& shape = geometry_.plane(plane);
      const SamplePlane inside =
          cropped(planes[static_cast<size_t>(plane)], shape.width, shape.height);
      const bool chroma = plane != Plane::kY;
      auto coded = encode_jpeg2000(inside, {header_.depth + (chroma ? 1 : 0), chroma});
      if (!coded) throw std::bad_alloc();
      const size_t entry = k * kPlaneCount + static_cast<size_t>(plane);
      codestreams[entry] = std::move(*coded);
      crcs[entry] = sample_crc(inside);
    }
  });
  return hmlfc::top_section(codestreams, crcs);
}

CodedImages EncodeSession::encode(uint32_t threshold_ref, uint32_t threshold_pred, bool last,
                                  const EncodeObserver& observer) {
  CodedImages images;
  images.codes.resize(static_cast<size_t>(geometry_.image_count()));
  RkvTree tree = last ? std::move(originals_) : originals_;
  EncodeParams params = params_;
  params.threshold_ref = threshold_ref;
  params.threshold_pred = threshold_pred;
  LevelTask task;
  task.light_field = &light_field_;
  task.geometry = &geometry_;
  task.params = &params;
  task.window = header_.window;
  task.tree = &tree;
  task.codes = &images.codes;
  task.error = &images.error;
  task.observer = &observer;
  for (int level = geometry_.top(); level >= 0; --level) {
    task.level = level;
    encode_level(task);
    // The level above has served as parent for the last time.
    if (level < geometry_.top()) tree.levels[static_cast<size_t>(level)].clear();
  }
  return images;
}

std::vector<uint8_t> EncodeSession::stream(CodedImages& images) const {
  IndexWriter index;
  for (ImageCode& image : images.codes) {
    for (const Plane plane : kPlanes) {
      PlaneCode& code = image[static_cast<size_t>(plane)];
      // A key image has no records: all its tiles are empty.
      code.record_sizes.resize(static_cast<size_t>(geometry_.plane(plane).tiles()), 0);
      size_t at = 0;
      for (const uint32_t size : code.record_sizes) {
        index.add(std::span(code.records).subspan(at, size));
        at += size;
      }
      code = {};
    }
  }
  index.finish();

  return assemble_stream(header_, top_, index);
}

}  // namespace hmlfc
