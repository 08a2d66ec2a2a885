#include <hmlfc/decoder.hpp>

#include <bit>
#include <memory>

#include "arithmetic/bise.hpp"
#include "decoder/decoder_state.hpp"
#include "decoder/fast/motion_field.hpp"
#include "decoder/golden/block_walk.hpp"
#include "decoder/request_guard.hpp"
#include "syntax/header.hpp"
#include "syntax/index.hpp"
#include "syntax/motion_tile.hpp"
#include "syntax/tile_masks.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {
namespace {

class StatisticsCollector {
 public:
  explicit StatisticsCollector(const StreamView& stream)
      : stream_(stream), field_(std::make_unique<MotionField>()) {}

  Result<StreamStatistics> run() {
    for (int level = stream_.geometry.top(); level >= 0; --level) {
      const LevelShape& shape = stream_.geometry.level(level);
      for (uint32_t row = 0; row < shape.rows; ++row) {
        for (uint32_t col = 0; col < shape.cols; ++col) {
          if (auto ok = add_image(level, {row, col}); !ok) return tl::unexpected(ok.error());
        }
      }
    }
    finish();
    return statistics_;
  }

 private:
  Result<void> add_image(int level, ImagePos image) {
    if (auto ok = add_motion_tiles(level, image); !ok) return ok;
    if (stream_.geometry.is_key(level, image)) return {};
    for (const Plane plane : kPlanes) {
      const PlaneShape& shape = stream_.geometry.plane(plane);
      for (uint32_t by = 0; by < shape.blocks_y; by += kTileBlocks) {
        for (uint32_t bx = 0; bx < shape.blocks_x; bx += kTileBlocks) {
          auto ok = add_tile({level, image.row, image.col, plane, bx, by});
          if (!ok) return ok;
        }
      }
    }
    return {};
  }

  // The fields of an image's motion tiles (MOT-3, MOT-6).
  Result<void> add_motion_tiles(int level, ImagePos image) {
    const bool reference = stream_.geometry.is_reference(level, image);
    if (reference && !stream_.header.has(Feature::kSharedDisparity)) return {};
    const auto& planes = stream_.geometry.motion_planes();
    for (size_t m = 0; m < planes.size(); ++m) {
      for (uint32_t ty = 0; ty < planes[m].tiles_y; ++ty) {
        for (uint32_t tx = 0; tx < planes[m].tiles_x; ++tx) {
          const MotionTilePlace place{level, image, m, tx, ty};
          if (auto ok = add_motion_tile(place, reference); !ok) return ok;
        }
      }
    }
    return {};
  }

  Result<void> add_motion_tile(const MotionTilePlace& place, bool reference) {
    const auto record = find_motion_record(stream_, place, Probe{});
    if (!record) return tl::unexpected(record.error());
    if (!*record) return {};
    FieldCursor cursor((*record)->bits, (*record)->file_bit, Probe{});
    if (reference) {
      const auto head = read_disparity_head(cursor, disparity_context(stream_, place));
      if (!head) return tl::unexpected(head.error());
    } else {
      const auto head = read_motion_head(cursor, motion_context(stream_, place));
      if (!head) return tl::unexpected(head.error());
    }
    motion_bits_ += cursor.position();
    return {};
  }

  Result<void> add_tile(const BlockSite& site) {
    const TileContext context = tile_context(stream_, site);
    TileHead head;
    const auto record = find_record(stream_, site, Probe{});
    if (!record) return tl::unexpected(record.error());
    if (*record) {
      FieldCursor cursor((*record)->bits, (*record)->file_bit, Probe{});
      const auto read = read_tile_head(cursor, context);
      if (!read) return tl::unexpected(read.error());
      head = *read;
      if (auto ok = add_record(cursor, head, context); !ok) return ok;
    }
    const auto motion = motion_mask(site, head, context);
    if (!motion) return tl::unexpected(motion.error());
    count_states(*motion, head.residual_mask, context);
    return {};
  }

  Result<void> add_record(FieldCursor& cursor, const TileHead& head, const TileContext& context) {
    motion_bits_ += head.residuals_begin - head.vectors_begin;
    if (head.residual_mask == 0) return {};
    const auto last = static_cast<unsigned>(63 - std::countl_zero(head.residual_mask));
    const auto entry = read_block_entry(cursor, head, context, last);
    if (!entry) return tl::unexpected(entry.error());
    const uint64_t end = entry->values_at + bise_bits(entry->levels, context.block_samples);
    residual_bits_ += end - head.residuals_begin;
    return {};
  }

  // The blocks with motion of the tile whose first block is `site` (TIL-5, MOT-5).
  Result<uint64_t> motion_mask(const BlockSite& site, const TileHead& head,
                               const TileContext& context) {
    if (!stream_.header.has(Feature::kMotionTiles)) return head.motion_mask;
    if (stream_.geometry.is_reference(site.level, {site.image_row, site.image_col})) return 0;
    uint64_t mask = 0;
    for (uint64_t left = context.blocks_inside; left != 0; left &= left - 1) {
      const auto k = static_cast<unsigned>(std::countr_zero(left));
      BlockSite at = site;
      at.bx += block_column(k);
      at.by += block_row(k);
      const auto moves = has_motion(at);
      if (!moves) return tl::unexpected(moves.error());
      mask |= uint64_t{*moves} << k;
    }
    return mask;
  }

  Result<bool> has_motion(const BlockSite& site) {
    const MotionPlace at = motion_place(stream_, site);
    const unsigned log2 = stream_.header.motion_tile_log2;
    const MotionTilePlace place{
        site.level, {site.image_row, site.image_col}, at.motion_plane, at.x >> log2, at.y >> log2};
    if (!(place == field_place_)) {
      if (auto ok = read_motion_field(stream_, place, *field_); !ok) {
        return tl::unexpected(ok.error());
      }
      field_place_ = place;
    }
    const uint32_t in_tile = (1u << log2) - 1;
    const PaletteEntry* entry = field_->entry((at.x & in_tile) >> field_->head.block_log2,
                                              (at.y & in_tile) >> field_->head.block_log2);
    if (entry == nullptr) return fail(ErrorCode::kBadMode, Section::kTile, 0);
    return entry->has_motion();
  }

  void count_states(uint64_t motion, uint64_t residual, const TileContext& context) {
    count(BlockState::kZero, context.blocks_inside & ~(motion | residual));
    count(BlockState::kMotion, motion & ~residual);
    count(BlockState::kMotionResidual, motion & residual);
    count(BlockState::kResidual, residual & ~motion);
  }

  void count(BlockState state, uint64_t blocks) {
    statistics_.states[static_cast<size_t>(state)] += static_cast<uint64_t>(std::popcount(blocks));
  }

  void finish() {
    SectionBytes& sections = statistics_.sections;
    sections.header = header_size(stream_.header);
    sections.top = stream_.entry(Section::kTop).size;
    sections.motion = motion_bits_ / 8;
    sections.residual = residual_bits_ / 8;
    sections.other = stream_.header.rig.size;
    sections.index = stream_.file.size() - sections.total();
  }

  const StreamView& stream_;
  StreamStatistics statistics_;
  uint64_t motion_bits_ = 0;
  uint64_t residual_bits_ = 0;
  std::unique_ptr<MotionField> field_;  // the motion tile read last
  MotionTilePlace field_place_{-1, {}, 0, 0, 0};
};

}  // namespace

Result<StreamStatistics> Decoder::statistics() const {
  return guard_request(state_->stream.source, [&] {
    load_images(state_->fast(), 0, false);
    return StatisticsCollector(state_->stream).run();
  });
}

}  // namespace hmlfc
