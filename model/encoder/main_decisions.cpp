// Profile main: energies, thresholds and the full search of the paper.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <vector>

#include "arithmetic/bise.hpp"
#include "arithmetic/reconstruct.hpp"
#include "bits/parallel.hpp"
#include "encoder/decisions.hpp"
#include "encoder/padded_plane.hpp"
#include "encoder/residual_writer.hpp"
#include "encoder/tile_writer.hpp"

namespace hmlfc {
namespace {

// One plane to encode.
struct PlaneTask {
  const Geometry& geometry;
  Plane plane;
  int depth;
  int window;
  bool both_signs;                            // search the additive phase too
  uint32_t threshold;                         // energy below which a block is dropped
  const SamplePlane& original;                // whole blocks, borders extended
  const SamplePlane* parent;                  // reconstructed, whole blocks; null at the top: 0
  const ReferencePlane* reference = nullptr;  // null in a reference image
};

// A plane that has been encoded.
struct EncodedPlane {
  PlaneCode code;
  SamplePlane samples;    // reconstructed (DEC-3), whole blocks
  SamplePlane residuals;  // TIL-10, 0 where there is none: what motion refers to; whole blocks
};

uint32_t energy_of(const BlockValues& values) {
  uint32_t sum = 0;
  for (const int32_t value : values.span()) sum += static_cast<uint32_t>(std::abs(value));
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

// Encodes a plane block by block: zero where the energy (sum of absolute values) of the difference
// to the parent lies below the threshold; else motion only where that of the best match does; else
// the cheaper of a residual with and without motion. Exact residuals, closed loop.
class PlaneEncoder {
 public:
  explicit PlaneEncoder(const PlaneTask& task)
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

    std::vector<BlockDecision> decisions(size_t{kTileBlocks} * kTileBlocks, BlockDecision(size_));
    for (unsigned k = 0; k < decisions.size(); ++k) {
      const uint32_t bx = tx * kTileBlocks + block_column(k);
      const uint32_t by = ty * kTileBlocks + block_row(k);
      if (bx >= shape_.blocks_x || by >= shape_.blocks_y) continue;
      decide(bx, by, decisions[k]);
      reconstruct(bx, by, decisions[k]);
    }
    result_.code.append(write_tile(decisions, context));
  }

  int32_t parent(uint32_t x, uint32_t y) const {
    return task_.parent == nullptr ? 0 : task_.parent->at(x, y);
  }

  // Calls body(i, x, y) for each value of a block with the nearest position inside the plane, so
  // that values outside repeat those inside and cost nothing.
  template <class Body>
  void for_each_inside(uint32_t bx, uint32_t by, const Body& body) const {
    for (unsigned j = 0; j < size_; ++j) {
      for (unsigned i = 0; i < size_; ++i) {
        const uint32_t x = std::min(bx * size_ + i, shape_.width - 1);
        const uint32_t y = std::min(by * size_ + j, shape_.height - 1);
        body(j * size_ + i, x, y);
      }
    }
  }

  // A(x, y) of DEC-3 with motion. Positions past the border have no meaning (STR-6) and take the
  // reference of the nearest position inside.
  int32_t predicted(uint32_t x, uint32_t y, const MotionMatch& motion) const {
    const int64_t from_x = int64_t{std::min(x, shape_.width - 1)} + motion.dx;
    const int64_t from_y = int64_t{std::min(y, shape_.height - 1)} + motion.dy;
    const int32_t reference = *task_.reference->sample(from_x, from_y);
    return motion_prediction(parent(x, y), motion.negative, reference, range_);
  }

  void decide(uint32_t bx, uint32_t by, BlockDecision& decision) {
    BlockValues plain(size_);
    for_each_inside(bx, by, [&](size_t i, uint32_t x, uint32_t y) {
      plain[i] = task_.original.at(x, y) - parent(x, y);
    });
    if (dropped(energy_of(plain))) return;
    decision.state = BlockState::kResidual;
    decision.residual = plain;
    if (task_.reference == nullptr) return;

    decision.motion = search(bx, by, plain);
    if (dropped(decision.motion.sad)) {
      decision.state = BlockState::kMotion;
      return;
    }
    BlockValues moved(size_);
    for_each_inside(bx, by, [&](size_t i, uint32_t x, uint32_t y) {
      moved[i] = task_.original.at(x, y) - predicted(x, y, decision.motion);
    });
    if (estimated_bits(moved) + vector_bits_ < estimated_bits(plain)) {
      decision.state = BlockState::kMotionResidual;
      decision.residual = moved;
    }
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
    for (unsigned j = 0; j < size_; ++j) {
      const uint32_t y = by * size_ + j;
      for (unsigned i = 0; i < size_; ++i) {
        const uint32_t x = bx * size_ + i;
        int32_t sample = parent(x, y);
        if (decision.has_motion()) sample = predicted(x, y, decision.motion);
        if (decision.has_residual()) {
          const int32_t residual = decision.residual.at(i, j);
          sample = add_residual(sample, residual, range_);
          result_.residuals.row(y)[x] = static_cast<int16_t>(residual);
        }
        result_.samples.row(y)[x] = static_cast<int16_t>(sample);
      }
    }
  }

  const PlaneTask& task_;
  PlaneShape shape_;
  unsigned size_;
  SampleRange range_;
  uint64_t vector_bits_;
  MotionMatch left_;
  std::vector<MotionMatch> above_;
  EncodedPlane result_;
};

class MainLevel final : public LevelDecisions {
 public:
  MainLevel(const EncodeParams& params, const LevelImages& images)
      : params_(params), images_(images), groups_(images.group_count()) {}

  void refine_keys(std::vector<ImagePlanes>&) override {}

  void take_key(ImagePos at, const ImagePlanes& decoded) override {
    for (const Plane plane : kPlanes) keep(at, plane, decoded[static_cast<size_t>(plane)]);
  }

  EncodedImage encode_reference(ImagePos at, const ImagePlanes& original) override {
    return encode_image(at, original, params_.main.threshold_ref, true);
  }

  PlaneCode decide_group(ImagePos) override { return {}; }

  EncodedImage encode_predictive(ImagePos at, const ImagePlanes& original) override {
    return encode_image(at, original, params_.main.threshold_pred, false);
  }

 private:
  using References = std::array<std::optional<ReferencePlane>, kPlaneCount>;

  // Keeps what the images of the group of `at` refer to, if there are any.
  void keep(ImagePos at, Plane plane, const SamplePlane& samples) {
    if (!images_.part().predicts) return;
    const PlaneShape& shape = images_.geometry().plane(plane);
    groups_[images_.group_of(at)][static_cast<size_t>(plane)].emplace(
        cropped(samples, shape.width, shape.height).samples, shape.width, shape.height,
        images_.header().window);
  }

  EncodedImage encode_image(ImagePos at, const ImagePlanes& original, uint32_t threshold,
                            bool is_reference) {
    EncodedImage image;
    parallel_for(kPlaneCount, [&](size_t p) {
      const Plane plane = kPlanes[p];
      PlaneTask task{images_.geometry(),
                     plane,
                     images_.header().depth,
                     images_.header().window,
                     params_.method != Method::kMc,
                     threshold,
                     original[p],
                     images_.parent(at, plane)};
      if (!is_reference) task.reference = &*groups_[images_.group_of(at)][p];
      EncodedPlane encoded = PlaneEncoder(task).run();
      if (is_reference) keep(at, plane, encoded.residuals);
      image.code[p] = std::move(encoded.code);
      image.samples[p] = std::move(encoded.samples);
    });
    return image;
  }

  const EncodeParams& params_;
  const LevelImages& images_;
  std::vector<References> groups_;
};

class MainDecisions final : public DecisionStrategy {
 public:
  explicit MainDecisions(const EncodeParams& params) : params_(params) {}

  double key_error(Plane) const override { return 0; }

  std::unique_ptr<LevelDecisions> begin_level(const LevelImages& images) const override {
    return std::make_unique<MainLevel>(params_, images);
  }

 private:
  EncodeParams params_;
};

}  // namespace

std::unique_ptr<DecisionStrategy> main_decisions(const EncodeParams& params) {
  return std::make_unique<MainDecisions>(params);
}

}  // namespace hmlfc
