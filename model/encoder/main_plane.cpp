#include "encoder/main_plane.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>
#include <vector>

#include "arithmetic/bise.hpp"
#include "arithmetic/reconstruct.hpp"
#include "bits/bit_string.hpp"
#include "encoder/residual_decision.hpp"
#include "encoder/residual_writer.hpp"
#include "encoder/tile_writer.hpp"
#include "syntax/tile_masks.hpp"

namespace hmlfc {
namespace {

// Level codes tried beside keeping all values as they are: up to 128 levels.
constexpr unsigned kTriedCodes = 19;

uint32_t energy_of(const BlockValues& values) {
  uint32_t sum = 0;
  for (const int32_t value : values.span()) sum += static_cast<uint32_t>(std::abs(value));
  return sum;
}

int64_t squared_error(const BlockValues& a, const BlockValues& b) {
  int64_t sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += int64_t{a[i] - b[i]} * (a[i] - b[i]);
  return sum;
}

// Bits of a residual block before its tile's parameters are known: with a bias of six bits, or
// none.
uint64_t estimated_bits(const BlockValues& residual) {
  constexpr unsigned kBiasBits = 6;
  const auto [lo, hi] = std::minmax_element(residual.span().begin(), residual.span().end());
  const ResidualInterval interval{*lo, *hi};
  const auto bits_with = [&](unsigned bias_bits) {
    const unsigned code = least_code(interval, bias_bits).level_code;
    return bias_bits + bise_bits(levels_of_code(code), residual.size());
  };
  return std::min(bits_with(0), bits_with(kBiasBits));
}

class PlaneEncoder {
 public:
  explicit PlaneEncoder(const MainPlaneTask& task)
      : task_(task),
        shape_(task.geometry.plane(task.plane)),
        size_(task.geometry.block_size()),
        range_(sample_range(task.plane, task.depth)),
        vector_bits_(uint64_t{2} * vector_widths(task.window).component_bits) {}

  EncodedPlane run() {
    result_.samples = SamplePlane(task_.original.width, task_.original.height);
    result_.residuals = SamplePlane(task_.original.width, task_.original.height);
    above_.resize(shape_.blocks_x);
    for (uint32_t ty = 0; ty < shape_.tiles_y; ++ty) {
      for (uint32_t tx = 0; tx < shape_.tiles_x; ++tx) encode_tile(tx, ty);
    }
    return std::move(result_);
  }

 private:
  void encode_tile(uint32_t tx, uint32_t ty) {
    TileContext context;
    context.predictive = task_.reference != nullptr;
    context.blocks_inside = blocks_inside(shape_, tx, ty);
    context.window = task_.window;
    context.depth = task_.depth;
    context.block_samples = uint64_t{size_} * size_;

    std::vector<BlockDecision> decisions(kBlocks, BlockDecision(size_));
    for_each_block(tx, ty, [&](unsigned k, uint32_t bx, uint32_t by) {
      by_rate() ? decide_motion(bx, by, decisions[k]) : decide(bx, by, decisions[k]);
    });
    if (by_rate()) keep_residuals(decisions, context);
    for_each_block(
        tx, ty, [&](unsigned k, uint32_t bx, uint32_t by) { reconstruct(bx, by, decisions[k]); });
    result_.code.append(write_tile(decisions, context));
  }

  bool by_rate() const { return task_.lambda.scaled > 0; }

  // Calls body(k, bx, by) for the blocks of a tile that lie in the plane.
  template <class Body>
  void for_each_block(uint32_t tx, uint32_t ty, const Body& body) const {
    for (unsigned k = 0; k < kBlocks; ++k) {
      const uint32_t bx = tx * kTileBlocks + block_column(k);
      const uint32_t by = ty * kTileBlocks + block_row(k);
      if (bx < shape_.blocks_x && by < shape_.blocks_y) body(k, bx, by);
    }
  }

  // A(x, y) of DEC-3, without motion where that is null. Positions past the border have no meaning
  // (STR-6) and take the reference of the nearest position inside.
  int32_t predicted(uint32_t x, uint32_t y, const MotionMatch* motion) const {
    const int32_t parent = task_.parent == nullptr ? 0 : task_.parent->at(x, y);
    if (motion == nullptr) return parent;
    const int64_t from_x = int64_t{std::min(x, shape_.width - 1)} + motion->dx;
    const int64_t from_y = int64_t{std::min(y, shape_.height - 1)} + motion->dy;
    const int32_t reference = *task_.reference->sample(from_x, from_y);
    return motion_prediction(parent, motion->negative, reference, range_);
  }

  // The original of a block less its prediction, with the nearest position inside the plane for
  // each one outside: values there repeat those inside and cost nothing.
  BlockValues block_differences(uint32_t bx, uint32_t by, const MotionMatch* motion) const {
    BlockValues values(size_);
    for (unsigned j = 0; j < size_; ++j) {
      for (unsigned i = 0; i < size_; ++i) {
        const uint32_t x = std::min(bx * size_ + i, shape_.width - 1);
        const uint32_t y = std::min(by * size_ + j, shape_.height - 1);
        values.at(i, j) = task_.original.at(x, y) - predicted(x, y, motion);
      }
    }
    return values;
  }

  void decide(uint32_t bx, uint32_t by, BlockDecision& decision) {
    const BlockValues plain = block_differences(bx, by, nullptr);
    if (dropped(energy_of(plain))) return;
    decision.state = BlockState::kResidual;
    decision.residual = plain;
    if (task_.reference == nullptr) return;

    decision.motion = search(bx, by, plain);
    if (dropped(decision.motion.sad)) {
      decision.state = BlockState::kMotion;
      return;
    }
    const BlockValues moved = block_differences(bx, by, &decision.motion);
    if (estimated_bits(moved) + vector_bits_ < estimated_bits(plain)) {
      decision.state = BlockState::kMotionResidual;
      decision.residual = moved;
    }
  }

  // Chooses between motion and none, by what either leaves to a residual, if there will be one.
  // `decision` gets these differences.
  void decide_motion(uint32_t bx, uint32_t by, BlockDecision& decision) {
    decision.residual = block_differences(bx, by, nullptr);
    if (task_.reference == nullptr) return;
    const int64_t vector = task_.lambda.cost(0, static_cast<int64_t>(vector_bits_));
    const int64_t plain = least_cost(decision.residual);
    if (plain <= vector) return;
    const MotionMatch match = search(bx, by, decision.residual);
    const BlockValues moved = block_differences(bx, by, &match);
    if (least_cost(moved) + vector >= plain) return;
    decision.state = BlockState::kMotion;
    decision.motion = match;
    decision.residual = moved;
  }

  // D + lambda R of differences, with the best residual or none.
  int64_t least_cost(const BlockValues& differences) const {
    ResidualCosts costs(differences, task_.lambda);
    std::array<LevelCosts, kTriedBiasBits.size()> rows;
    costs.weigh(1, kTriedCodes, rows);
    int64_t least = std::min(costs.zero(), exact_cost(differences));
    for (size_t b = 0; b < rows.size(); ++b) {
      const int64_t head = task_.lambda.cost(0, kTriedBiasBits[b] + kMaskBitsPerBlock);
      least = std::min(least, head + *std::ranges::min_element(rows[b]));
    }
    return least;
  }

  // Chooses the blocks of a tile that keep a residual, and its values.
  void keep_residuals(std::vector<BlockDecision>& decisions, const TileContext& context) const {
    std::vector<BlockValues> differences;
    for (const BlockDecision& decision : decisions) differences.push_back(decision.residual);
    ResidualRules rules{task_.lambda, 0, 0, 0};
    rules.bias_widths = kTriedBiasBits.size();
    rules.level_codes = kTriedCodes;
    const ResidualTile tile = decide_residuals(differences, context, rules);
    const int64_t head = tile.mask == 0 ? task_.lambda.cost(0, kLeastResidualBits) : 0;
    size_t kept = 0;
    for (unsigned k = 0; k < kBlocks; ++k) {
      BlockDecision& decision = decisions[k];
      const bool tried = has_bit(tile.mask, k);
      const BlockValues values = tried ? tile.blocks[kept++] : BlockValues(size_);
      const int64_t bits = tried ? static_cast<int64_t>(estimated_bits(values)) : 0;
      const int64_t least = task_.lambda.cost(squared_error(decision.residual, values), bits);
      // At high quality, values far apart are worth more levels than are tried.
      const bool exact = exact_cost(decision.residual) + head < least;
      if (!tried && !exact) continue;
      decision.state = decision.has_motion() ? BlockState::kMotionResidual : BlockState::kResidual;
      if (!exact) decision.residual = values;
    }
  }

  // D + lambda R where all differences are kept.
  int64_t exact_cost(const BlockValues& differences) const {
    const auto bits = static_cast<int64_t>(estimated_bits(differences));
    return task_.lambda.cost(0, bits + kMaskBitsPerBlock);
  }

  bool dropped(uint32_t energy) const { return energy == 0 || energy < task_.threshold; }

  MotionMatch search(uint32_t bx, uint32_t by, const BlockValues& plain) {
    std::array<int16_t, size_t{kMaxBlockSize} * kMaxBlockSize> block;
    for (size_t i = 0; i < plain.size(); ++i) block[i] = static_cast<int16_t>(plain[i]);
    const std::array<MotionMatch, 2> hints{left_, above_[bx]};
    const MotionMatch match =
        search_motion(std::span(block).first(plain.size()), static_cast<int>(size_), bx * size_,
                      by * size_, *task_.reference, task_.window, task_.both_signs, hints);
    left_ = match;
    above_[bx] = match;
    return match;
  }

  void reconstruct(uint32_t bx, uint32_t by, const BlockDecision& decision) {
    const MotionMatch* motion = decision.has_motion() ? &decision.motion : nullptr;
    for (unsigned j = 0; j < size_; ++j) {
      const uint32_t y = by * size_ + j;
      for (unsigned i = 0; i < size_; ++i) {
        const uint32_t x = bx * size_ + i;
        int32_t sample = predicted(x, y, motion);
        if (decision.has_residual()) {
          const int32_t residual = decision.residual.at(i, j);
          sample = add_residual(sample, residual, range_);
          result_.residuals.row(y)[x] = static_cast<int16_t>(residual);
        }
        result_.samples.row(y)[x] = static_cast<int16_t>(sample);
      }
    }
  }

  static constexpr unsigned kBlocks = kTileBlocks * kTileBlocks;

  const MainPlaneTask& task_;
  PlaneShape shape_;
  unsigned size_;
  SampleRange range_;
  uint64_t vector_bits_;
  MotionMatch left_;
  std::vector<MotionMatch> above_;
  EncodedPlane result_;
};

}  // namespace

EncodedPlane encode_main_plane(const MainPlaneTask& task) { return PlaneEncoder(task).run(); }

}  // namespace hmlfc
