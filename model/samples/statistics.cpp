#include <hmlfc/decoder.hpp>

#include <bit>

#include "fields/block_entry.hpp"
#include "fields/header.hpp"
#include "fields/tile_record.hpp"
#include "samples/decoder_state.hpp"
#include "values/bise.hpp"

namespace hmlfc {
namespace {

class StatisticsCollector {
 public:
  explicit StatisticsCollector(const StreamView& stream) : stream_(stream) {}

  Result<StreamStatistics> run() {
    for (int level = stream_.geometry.top(); level >= 0; --level) {
      const LevelShape& shape = stream_.geometry.level(level);
      for (uint32_t row = 0; row < shape.rows; ++row) {
        for (uint32_t col = 0; col < shape.cols; ++col) {
          if (stream_.geometry.is_key(level, {row, col})) continue;
          if (auto ok = add_image(level, {row, col}); !ok) return tl::unexpected(ok.error());
        }
      }
    }
    finish();
    return statistics_;
  }

 private:
  Result<void> add_image(int level, ImagePos image) {
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

  Result<void> add_tile(const BlockSite& site) {
    const TileContext context = tile_context(stream_, site);
    const auto record = find_record(stream_, site, Probe{});
    if (!record) return tl::unexpected(record.error());
    if (!*record) {
      count(BlockState::kZero, context.blocks_inside);
      return {};
    }
    FieldCursor cursor((*record)->bits, (*record)->file_bit, Probe{});
    const auto head = read_tile_head(cursor, context);
    if (!head) return tl::unexpected(head.error());
    return add_record(cursor, *head, context);
  }

  Result<void> add_record(FieldCursor& cursor, const TileHead& head, const TileContext& context) {
    const uint64_t motion = head.motion_mask;
    const uint64_t residual = head.residual_mask;
    count(BlockState::kZero, context.blocks_inside & ~(motion | residual));
    count(BlockState::kMotion, motion & ~residual);
    count(BlockState::kMotionResidual, motion & residual);
    count(BlockState::kResidual, residual & ~motion);
    motion_bits_ += head.residuals_begin - head.vectors_begin;
    if (residual == 0) return {};
    const auto last = static_cast<unsigned>(63 - std::countl_zero(residual));
    const auto entry = read_block_entry(cursor, head, context, last);
    if (!entry) return tl::unexpected(entry.error());
    const uint64_t end = entry->values_at + bise_bits(entry->levels, context.block_samples);
    residual_bits_ += end - head.residuals_begin;
    return {};
  }

  void count(BlockState state, uint64_t blocks) {
    statistics_.states[static_cast<size_t>(state)] += static_cast<uint64_t>(std::popcount(blocks));
  }

  void finish() {
    SectionBytes& sections = statistics_.sections;
    sections.header = header_size(stream_.header.tree_height);
    sections.top = stream_.entry(Section::kTop).size;
    sections.motion = motion_bits_ / 8;
    sections.residual = residual_bits_ / 8;
    sections.index = stream_.file.size() - sections.total();
  }

  const StreamView& stream_;
  StreamStatistics statistics_;
  uint64_t motion_bits_ = 0;
  uint64_t residual_bits_ = 0;
};

}  // namespace

Result<StreamStatistics> Decoder::statistics() const {
  return StatisticsCollector(state_->stream).run();
}

}  // namespace hmlfc
