// Disparity maps, tile by tile: equal to walk_to_block_disparity on each block.
#include <hmlfc/disparity.hpp>

#include <memory>
#include <optional>
#include <vector>

#include "decoder/fast/motion_field.hpp"
#include "decoder/golden/block_decoder.hpp"
#include "decoder/golden/block_walk.hpp"
#include "decoder/missing_ranges.hpp"
#include "decoder/open_stream.hpp"
#include "decoder/request_guard.hpp"
#include "render/block_disparity.hpp"
#include "render/told_disparity.hpp"

namespace hmlfc {
namespace {

// Reads one ancestor of the view, in a stream with motion tiles.
class AncestorMotion {
 public:
  AncestorMotion(const StreamView& stream, int level, ImagePos image)
      : stream_(stream), level_(level), image_(image), told_(stream, level, image) {
    if (stream.header.has(Feature::kSharedDisparity)) {
      const size_t plane = stream.geometry.motion_plane_of(Plane::kY);
      shared_.emplace(stream, level, stream.geometry.reference_of(level, image), plane);
    }
  }

  struct Found {
    bool readable = true;
    std::optional<BlockDisparity> told{};
  };

  // Finds what block (bx, by) of plane Y tells; not readable: what it needs has an error.
  Found find(uint32_t bx, uint32_t by) {
    if (told_.source() == DisparitySource::kNone) return {};
    const MotionPlace place =
        motion_place(stream_, {level_, image_.row, image_.col, Plane::kY, bx, by});
    if (told_.source() == DisparitySource::kShared) {
      return {true, find_shared(place, kChoiceOwn).told};
    }
    const PaletteEntry* entry = entry_at(place);
    if (entry == nullptr) return {false};
    if (entry->shares_disparity()) return find_shared(place, entry->choice);
    return {true, told_.of_entry(*entry, 0)};
  }

 private:
  Found find_shared(const MotionPlace& place, unsigned choice) const {
    const auto disparity =
        shared_->find(grid_block(place.x, place.y, choice, stream_.header.disparity_grid_log2,
                                 stream_.geometry.motion_planes()[place.motion_plane]));
    if (!disparity) return {false};
    return {true, told_.shared(*disparity)};
  }

  // Null where it cannot be read.
  const PaletteEntry* entry_at(const MotionPlace& place) {
    const unsigned log2 = stream_.header.motion_tile_log2;
    const MotionTilePlace tile{level_, image_, place.motion_plane, place.x >> log2,
                               place.y >> log2};
    const uint32_t tiles_x = stream_.geometry.motion_planes()[place.motion_plane].tiles_x;
    if (fields_.size() != tiles_x) fields_.resize(tiles_x);
    TileField& held = fields_[tile.tx];
    if (!held.field || held.ty != tile.ty) {
      if (!held.field) held.field = std::make_unique<MotionField>();
      held.ty = tile.ty;
      held.readable = read_motion_field(stream_, tile, *held.field).has_value();
    }
    if (!held.readable) return nullptr;
    const uint32_t in_tile = (1u << log2) - 1;
    return held.field->entry((place.x & in_tile) >> held.field->head.block_log2,
                             (place.y & in_tile) >> held.field->head.block_log2);
  }

  struct TileField {
    std::unique_ptr<MotionField> field;
    uint32_t ty = 0;
    bool readable = false;
  };

  const StreamView& stream_;
  int level_;
  ImagePos image_;
  ToldDisparity told_;
  std::optional<DisparityPlane> shared_;  // of the reference image
  std::vector<TileField> fields_;         // of one row of motion tiles
};

// The map of one view, or rows of it, whose blocks are asked for row by row.
class MapReader {
 public:
  MapReader(const StreamView& stream, ViewPos view) : stream_(stream), view_(view) {
    if (!stream.header.has(Feature::kMotionTiles)) return;
    const ImagePos own{view.row, view.col};
    const int last = first_level(stream.geometry, 0, own);
    for (int level = 0; level <= last; ++level) {
      ancestors_.push_back(
          std::make_unique<AncestorMotion>(stream, level, stream.geometry.ancestor(own, 0, level)));
    }
  }

  Result<BlockDisparity> block(uint32_t bx, uint32_t by) {
    for (const auto& ancestor : ancestors_) {
      const auto found = ancestor->find(bx, by);
      // The golden path names the error.
      if (!found.readable) return walk_to_block_disparity(stream_, view_, bx, by, nullptr);
      if (found.told) return *found.told;
    }
    if (!ancestors_.empty()) return BlockDisparity{};
    return walk_to_block_disparity(stream_, view_, bx, by, nullptr);
  }

 private:
  const StreamView& stream_;
  ViewPos view_;
  std::vector<std::unique_ptr<AncestorMotion>> ancestors_;  // from level 0 up; with motion tiles
};

// Loads what the map of `view` reads of a partial source.
void load_map(const StreamView& stream, ViewPos view) {
  const uint32_t rows = stream.geometry.plane(Plane::kY).blocks_y;
  load_by_trials(stream, [&](const StreamView& trial, const MissingRanges&) {
    disparity_rows(trial, view, 0, rows);
  });
}

}  // namespace

std::vector<BlockDisparity> disparity_rows(const StreamView& stream, ViewPos view, uint32_t begin,
                                           uint32_t end) {
  const uint32_t columns = stream.geometry.plane(Plane::kY).blocks_x;
  std::vector<BlockDisparity> rows;
  rows.reserve(size_t{columns} * (end - begin));
  MapReader reader(stream, view);
  for (uint32_t by = begin; by < end; ++by) {
    for (uint32_t bx = 0; bx < columns; ++bx) {
      rows.push_back(reader.block(bx, by).value_or(BlockDisparity{}));
    }
  }
  return rows;
}

Result<DisparityMap> disparity_map(const Decoder& decoder, ViewPos view) {
  const StreamView& stream = DecoderAccess::stream(decoder);
  const StreamHeader& header = stream.header;
  if (view.row >= header.rows || view.col >= header.cols) {
    return fail(ErrorCode::kBadRequest, Section::kHeader, 0);
  }
  return guard_request(stream.source, [&]() -> Result<DisparityMap> {
    const PlaneShape& plane = stream.geometry.plane(Plane::kY);
    DisparityMap map{header.width, header.height, header.block_size(), plane.blocks_x, {}};
    map.blocks.reserve(size_t{plane.blocks_x} * plane.blocks_y);
    if (stream.source != nullptr) load_map(stream, view);
    MapReader reader(stream, view);
    for (uint32_t by = 0; by < plane.blocks_y; ++by) {
      for (uint32_t bx = 0; bx < plane.blocks_x; ++bx) {
        const auto block = reader.block(bx, by);
        if (!block) return tl::unexpected(block.error());
        map.blocks.push_back(*block);
      }
    }
    return map;
  });
}

}  // namespace hmlfc
