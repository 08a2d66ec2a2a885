#include "decoder/fast/tile_blocks.hpp"

#include <bit>
#include <cstdlib>

#include "arithmetic/bise.hpp"
#include "arithmetic/reconstruct.hpp"
#include "arithmetic/widths.hpp"
#include "bits/bit_string.hpp"
#include "decoder/fast/bise_unpack.hpp"
#include "syntax/index.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {
namespace {

struct TileReader {
  const PaddedRecord& record;
  const TileHead& head;
  const TileContext& context;
  const SampleRange& range;
  TileBlocks& blocks;

  tl::unexpected<Error> failure(ErrorCode code) const { return fail(code, Section::kTile, 0); }

  Result<void> read_vectors() const {
    const TileVectors& vectors = head.vectors;
    const auto count = static_cast<size_t>(std::popcount(head.motion_mask));
    std::array<uint16_t, kBlocksInTile> x;
    std::array<uint16_t, kBlocksInTile> y;
    bise_unpack(record.data(), vectors.x_at, vectors.levels_x, count, x.data());
    bise_unpack(record.data(), vectors.y_at, vectors.levels_y, count, y.data());
    uint64_t left = head.motion_mask;
    for (size_t m = 0; m < count; ++m, left &= left - 1) {
      const auto k = static_cast<size_t>(std::countr_zero(left));
      const int32_t dx = vectors.min_x + x[m];
      const int32_t dy = vectors.min_y + y[m];
      if (std::abs(dx) > context.window || std::abs(dy) > context.window) {
        return failure(ErrorCode::kVectorRange);
      }
      blocks.dx[k] = narrow<int8_t>(dx);
      blocks.dy[k] = narrow<int8_t>(dy);
      const bool mixed = vectors.sign_mode == kSignsMixed;
      blocks.negative[k] = mixed ? record.bits().field(vectors.signs_at + m, 1) != 0
                                 : vectors.sign_mode == kSignsMinus;
    }
    return {};
  }

  Result<void> read_residuals(uint64_t wanted) const {
    const TileResiduals& residuals = head.residuals;
    const BitString bits = record.bits();
    const unsigned max_code = max_residual_level_code(context.depth);
    uint64_t header_at = residuals.headers_at;
    uint64_t values_at = residuals.values_at;
    for (uint64_t left = head.residual_mask; left != 0; left &= left - 1) {
      const auto k = static_cast<unsigned>(std::countr_zero(left));
      const unsigned code = residuals.level_base + bits.field(header_at, residuals.level_bits);
      const unsigned step_code =
          residuals.step_base + bits.field(header_at + residuals.level_bits, residuals.step_bits);
      if (code > max_code || step_code > kMaxStepCode) return failure(ErrorCode::kBadLevels);
      const Levels levels = levels_of_code(code);
      const uint64_t size = bise_bits(levels, context.block_samples);
      if (!bits.holds(values_at, size)) return failure(ErrorCode::kTileOverrun);
      if (has_bit(wanted, k)) {
        const uint32_t bias =
            bits.field(header_at + residuals.level_bits + residuals.step_bits, residuals.bias_bits);
        unpack_block(k, values_at, levels, sign_extend(bias, residuals.bias_bits),
                     step_of_code(step_code));
      }
      header_at += residuals.header_bits();
      values_at += size;
    }
    return {};
  }

  void unpack_block(unsigned k, uint64_t at, const Levels& levels, int32_t bias,
                    int32_t step) const {
    std::array<uint16_t, size_t{kMaxBlockSize} * kMaxBlockSize> values;
    bise_unpack(record.data(), at, levels, blocks.block_samples, values.data());
    int16_t* out = blocks.values.data() + size_t{k} * blocks.block_samples;
    for (size_t i = 0; i < context.block_samples; ++i) {
      out[i] = narrow<int16_t>(stepped_residual(values[i], levels.count, bias, step, range));
    }
  }
};

}  // namespace

Result<void> read_tile_blocks(const StreamView& stream, const BlockSite& site, uint64_t wanted,
                              TileBlocks& blocks) {
  blocks.motion_mask = 0;
  blocks.residual_mask = 0;
  blocks.block_samples = stream.geometry.block_size() * stream.geometry.block_size();
  const auto found = find_record(stream, site, Probe{});
  if (!found) return tl::unexpected(found.error());
  if (!*found) return {};
  const PaddedRecord record((*found)->bits.bytes());
  FieldCursor cursor(record.bits(), (*found)->file_bit, Probe{});
  const TileContext context = tile_context(stream, site);
  const auto head = read_tile_head(cursor, context);
  if (!head) return tl::unexpected(head.error());
  blocks.motion_mask = head->motion_mask;
  blocks.residual_mask = head->residual_mask;

  const SampleRange range = sample_range(site.plane, stream.header.depth);
  const TileReader reader{record, *head, context, range, blocks};
  if (head->motion_mask != 0) {
    if (auto ok = reader.read_vectors(); !ok) return ok;
  }
  if (head->residual_mask != 0) return reader.read_residuals(wanted);
  return {};
}

}  // namespace hmlfc
