#include <hmlfc/decoder.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <utility>
#include <vector>

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
  explicit StatisticsCollector(const StreamView& stream) : stream_(stream), entries_(stream) {}

  Result<StreamStatistics> run() {
    for (int level = stream_.geometry.top(); level >= 0; --level) {
      for (const ImagePos image : stream_.geometry.level(level).all_images()) {
        if (auto ok = add_image(level, image); !ok) return tl::unexpected(ok.error());
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
      if (auto ok = add_plane(level, image, plane); !ok) return ok;
    }
    return {};
  }

  // The fields of an image's motion tiles (MOT-3, MOT-6).
  Result<void> add_motion_tiles(int level, ImagePos image) {
    for (std::vector<uint64_t>& tiles : moved_) tiles.clear();
    const Geometry& geometry = stream_.geometry;
    const bool reference = geometry.is_reference(level, image);
    if (reference && !stream_.header.has(Feature::kSharedDisparity)) return {};
    const uint64_t number = geometry.image_number(level, image);
    for (size_t m = 0; m < geometry.motion_planes().size(); ++m) {
      const MotionPlaneShape& shape = geometry.motion_planes()[m];
      const uint64_t first = geometry.motion_tile_number(number, m, 0, 0);
      for (uint64_t tile = 0;; ++tile) {
        const auto next = next_tile(stream_, first + tile, first + shape.tiles());
        if (!next) return tl::unexpected(next.error());
        tile = *next - first;
        if (tile == shape.tiles()) break;
        const MotionTilePlace place{level, image, m, static_cast<uint32_t>(tile % shape.tiles_x),
                                    static_cast<uint32_t>(tile / shape.tiles_x)};
        if (auto ok = add_motion_tile(place, reference); !ok) return ok;
        if (!reference) note_moved(place);
      }
    }
    return {};
  }

  // The tiles with blocks that take their motion from `place`, which is not empty, and perhaps some
  // next to them (MOT-4).
  void note_moved(const MotionTilePlace& place) {
    const Geometry& geometry = stream_.geometry;
    const unsigned side_log2 = stream_.header.motion_tile_log2;
    for (const Plane plane : kPlanes) {
      if (geometry.motion_plane_of(plane) != place.motion_plane) continue;
      const bool doubled =
          plane != Plane::kY && geometry.motion_planes()[place.motion_plane].halves;
      const PlaneShape& shape = geometry.plane(plane);
      const auto tile_of = [&](uint64_t sample, uint32_t tiles) {
        const uint64_t tile =
            (sample >> (doubled ? 1 : 0) >> stream_.header.block_log2) / kTileBlocks;
        return std::min<uint64_t>(tile, tiles - 1);
      };
      const auto range = [&](uint64_t number, uint32_t tiles) {
        return std::pair(tile_of(number << side_log2, tiles),
                         tile_of(((number + 1) << side_log2) - 1, tiles));
      };
      const auto [top, bottom] = range(place.ty, shape.tiles_y);
      const auto [left, right] = range(place.tx, shape.tiles_x);
      for (uint64_t ty = top; ty <= bottom; ++ty) {
        for (uint64_t tx = left; tx <= right; ++tx) {
          moved_[static_cast<size_t>(plane)].push_back(ty * shape.tiles_x + tx);
        }
      }
    }
  }

  // Blocks of tiles that are empty and whose motion tiles are empty have one state.
  Result<void> add_plane(int level, ImagePos image, Plane plane) {
    const Geometry& geometry = stream_.geometry;
    const PlaneShape& shape = geometry.plane(plane);
    const uint64_t first = geometry.tile_number(geometry.image_number(level, image), plane, 0, 0);
    std::vector<uint64_t>& moved = moved_[static_cast<size_t>(plane)];
    std::ranges::sort(moved);
    uint64_t rest = uint64_t{shape.blocks_x} * shape.blocks_y;
    size_t noted = 0;
    for (uint64_t tile = 0;; ++tile) {
      while (noted < moved.size() && moved[noted] < tile) ++noted;
      const uint64_t end = noted < moved.size() ? moved[noted] : shape.tiles();
      const auto next = next_tile(stream_, first + tile, first + end);
      if (!next) return tl::unexpected(next.error());
      tile = *next - first;
      if (tile == shape.tiles()) break;
      const auto tx = static_cast<uint32_t>(tile % shape.tiles_x);
      const auto ty = static_cast<uint32_t>(tile / shape.tiles_x);
      const auto ok =
          add_tile({level, image.row, image.col, plane, tx * kTileBlocks, ty * kTileBlocks});
      if (!ok) return ok;
      rest -= static_cast<uint64_t>(std::popcount(blocks_inside(shape, tx, ty)));
    }
    const bool moves = stream_.header.has(Feature::kMotionTiles) && geometry.level(level).keyed;
    statistics_.states[static_cast<size_t>(moves ? BlockState::kMotion : BlockState::kZero)] +=
        rest;
    return {};
  }

  // Every record has a byte of its own, unless tiles share records.
  Result<void> count_record() {
    constexpr uint64_t kFew = uint64_t{1} << 20;
    if (++records_ <= kFew + 4 * stream_.entry(Section::kTile).size) return {};
    return stream_.error(ErrorCode::kLimitExceeded, Section::kGroup, 0);
  }

  Result<void> add_motion_tile(const MotionTilePlace& place, bool reference) {
    const auto record = find_motion_record(stream_, place, Probe{});
    if (!record) return tl::unexpected(record.error());
    if (!*record) return {};
    if (auto ok = count_record(); !ok) return ok;
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
      if (auto ok = count_record(); !ok) return ok;
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
      const auto entry = entries_.find(at);
      if (!entry) return tl::unexpected(entry.error());
      if (*entry == nullptr) return fail(ErrorCode::kBadMode, Section::kTile, 0);
      mask |= uint64_t{(*entry)->has_motion()} << k;
    }
    return mask;
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
  std::array<std::vector<uint64_t>, kPlaneCount> moved_;  // of the image; numbers in the plane
  uint64_t records_ = 0;
  uint64_t motion_bits_ = 0;
  uint64_t residual_bits_ = 0;
  MotionEntries entries_;
};

// All of them are read: at once, where the source is partial.
void load_tiles(const StreamView& stream) {
  if (stream.source == nullptr) return;
  std::array<ByteRange, 3> ranges;
  std::ranges::transform(std::array{Section::kRoot, Section::kGroup, Section::kTile},
                         ranges.begin(), [&](Section section) {
                           const SectionEntry& entry = stream.entry(section);
                           return ByteRange{entry.offset, entry.size};
                         });
  stream.source->load(ranges);
}

}  // namespace

Result<StreamStatistics> Decoder::statistics() const {
  return guard_request(state_->stream.source, [&] {
    load_tiles(state_->stream);
    return StatisticsCollector(state_->stream).run();
  });
}

}  // namespace hmlfc
