#include "encoder/residual_plane.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "arithmetic/reconstruct.hpp"
#include "bits/bit_string.hpp"
#include "encoder/error_kernels.hpp"
#include "syntax/tile_masks.hpp"

namespace hmlfc {
namespace {

constexpr unsigned kBlocksPerTile = kTileBlocks * kTileBlocks;

class ResidualEncoder {
 public:
  ResidualEncoder(const Geometry& geometry, Plane plane, int depth, const SamplePlane& original,
                  const SamplePlane& prediction, bool is_reference, const ResidualRules& rules)
      : shape_(geometry.plane(plane)),
        size_(geometry.block_size()),
        range_(sample_range(plane, depth)),
        original_(original),
        prediction_(prediction),
        rules_(rules) {
    context_.depth = depth;
    context_.block_samples = uint64_t{size_} * size_;
    encoded_.samples = prediction;
    if (is_reference) encoded_.residuals = SamplePlane(prediction.width, prediction.height);
  }

  EncodedPlane run() {
    for (uint32_t ty = 0; ty < shape_.tiles_y; ++ty) {
      for (uint32_t tx = 0; tx < shape_.tiles_x; ++tx) {
        encode_tile(tx, ty);
      }
    }
    return std::move(encoded_);
  }

 private:
  void encode_tile(uint32_t tx, uint32_t ty) {
    // A tile whose error is worth less than a record stays empty.
    const int64_t record = rules_.lossless ? 0 : kLeastResidualBits;
    if (most_saved(left(tx, 0), top(ty, 0)) <= rules_.lambda.cost(0, record)) {
      return encoded_.code.append({});
    }
    context_.blocks_inside = blocks_inside(shape_, tx, ty);
    for (unsigned k = 0; k < kBlocksPerTile; ++k) {
      if (has_bit(context_.blocks_inside, k)) subtract(tx, ty, k, differences_[k]);
    }
    const ResidualTile tile = decide_residuals(differences_, context_, rules_);
    encoded_.code.append(write_residual_tile(tile, context_));
    size_t m = 0;
    for (unsigned k = 0; k < kBlocksPerTile; ++k) {
      if (has_bit(tile.mask, k)) add(tx, ty, k, tile.blocks[m++]);
    }
  }

  // What residuals of the blocks in the tile from (x, y) on could save, or more: the squared error
  // of 4x4 samples, each less what a block of at most this size takes in the mask. HeadSearch adds
  // 1 for each block, of which there are up to four.
  int64_t most_saved(uint32_t x, uint32_t y) const {
    const uint32_t side = kTileBlocks * size_;
    const uint32_t columns = std::min(side, shape_.width - x);
    const uint32_t end = std::min(y + side, shape_.height);
    const int64_t least =
        rules_.lossless || size_ > 4 ? 0 : rules_.lambda.cost(0, kMaskBitsPerBlock);
    std::array<uint32_t, kTileBlocks * kMaxBlockSize / 4> squares{};
    int64_t sum = 0;
    for (; y < end; y += 4) {
      square_errors({original_.row(y).data() + x, original_.width, prediction_.width, columns,
                     std::min(4u, end - y)},
                    prediction_.row(y).data() + x, squares.data());
      for (uint32_t i = 0; i < ceil_div(columns, 4u); ++i) {
        if (squares[i] == 0) continue;
        sum += std::max<int64_t>(0, rules_.lambda.cost(squares[i] + 4, 0) - least);
      }
    }
    return sum;
  }

  uint32_t left(uint32_t tx, unsigned k) const {
    return (tx * kTileBlocks + block_column(k)) * size_;
  }
  uint32_t top(uint32_t ty, unsigned k) const { return (ty * kTileBlocks + block_row(k)) * size_; }

  // 0 outside the plane, where values have no meaning.
  void subtract(uint32_t tx, uint32_t ty, unsigned k, BlockValues& block) const {
    const uint32_t x = left(tx, k);
    for (unsigned j = 0; j < size_; ++j) {
      const uint32_t y = top(ty, k) + j;
      const int16_t* original = original_.row(y).data() + x;
      const int16_t* prediction = prediction_.row(y).data() + x;
      for (unsigned i = 0; i < size_; ++i) {
        const bool inside = x + i < shape_.width && y < shape_.height;
        block.at(i, j) = inside ? original[i] - prediction[i] : 0;
      }
    }
  }

  void add(uint32_t tx, uint32_t ty, unsigned k, const BlockValues& values) {
    for (unsigned j = 0; j < size_; ++j) {
      const uint32_t y = top(ty, k) + j;
      for (unsigned i = 0; i < size_; ++i) {
        const uint32_t x = left(tx, k) + i;
        const int32_t residual = clamp(values.at(i, j), -range_.bound, range_.bound);
        const int32_t sample = add_residual(prediction_.at(x, y), residual, range_);
        encoded_.samples.row(y)[x] = static_cast<int16_t>(sample);
        if (encoded_.residuals.width > 0) {
          encoded_.residuals.row(y)[x] = static_cast<int16_t>(residual);
        }
      }
    }
  }

  const PlaneShape& shape_;
  unsigned size_;
  SampleRange range_;
  const SamplePlane& original_;
  const SamplePlane& prediction_;
  const ResidualRules& rules_;
  TileContext context_;
  std::vector<BlockValues> differences_{kBlocksPerTile, BlockValues(size_)};
  EncodedPlane encoded_;
};

}  // namespace

EncodedPlane encode_residuals(const Geometry& geometry, Plane plane, int depth,
                              const SamplePlane& original, const SamplePlane& prediction,
                              bool is_reference, const ResidualRules& rules) {
  return ResidualEncoder(geometry, plane, depth, original, prediction, is_reference, rules).run();
}

}  // namespace hmlfc
