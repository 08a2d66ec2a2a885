#include "encoder/key_refinement.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "arithmetic/motion.hpp"
#include "arithmetic/reconstruct.hpp"
#include "arithmetic/rounding.hpp"
#include "bits/parallel.hpp"
#include "encoder/motion_prediction.hpp"

namespace hmlfc {
namespace {

// A plane is refined if the first step lowers the sum by this share, at least. Noise and blur give
// more; what is encoded again after decoding has less to gain, and would drift from its original.
constexpr int64_t kLeastGainDivisor = 20;
// Weight of a squared error of the key image against its view; one of another image weighs 1.
constexpr int64_t kOwnWeightNumerator = 3;
constexpr int64_t kOwnWeightDenominator = 2;

class PlaneRefinement {
 public:
  PlaneRefinement(const KeyRefinement& task, size_t plane, SamplePlane& key)
      : task_(task),
        plane_(plane),
        key_(key),
        view_(key),
        shape_(task.geometry.plane(kPlanes[plane])),
        halved_(plane > 0 && task.header.chroma_format == ChromaFormat::k420),
        block_size_((1 << task.header.disparity_grid_log2) >> (halved_ ? 1 : 0)),
        pad_(task.header.window + 10),
        stride_(static_cast<ptrdiff_t>(shape_.width) + 2 * static_cast<ptrdiff_t>(pad_)),
        range_(sample_range(kPlanes[plane], task.header.depth)),
        bound_(reference_bound(kPlanes[plane], task.header.depth, true)),
        rules_(vector_rules(task.header)),
        estimate_(task.lambdas[plane]),
        own_weight_(std::max<int64_t>(
            1, kOwnWeightNumerator * kWeight * kTapSum * static_cast<int64_t>(task.targets.size()) /
                   (kOwnWeightDenominator * static_cast<int64_t>(task.images)))) {
    for (const int16_t sample : key.samples) fine_.push_back(sample * (1 << kFractionBits));
  }

  void run() {
    const size_t size =
        static_cast<size_t>(stride_) * (shape_.height + 2 * static_cast<size_t>(pad_));
    int64_t unrefined = 0;
    for (int step = 0; step < task_.steps[plane_]; ++step) {
      const PaddedPlane reference(key_, shape_.width, shape_.height, pad_);
      errors_.assign(size, 0);
      weights_.assign(size, 0);
      left_ = 0;
      for (const RefinementTarget& target : task_.targets) add(target, reference);
      const int64_t sum = left_ + own_weight_ * own_error() / (kWeight * kTapSum);
      if (step == 0) unrefined = sum;
      if (step == 1 && sum > unrefined - unrefined / kLeastGainDivisor) {
        key_ = view_;
        return;
      }
      move();
    }
  }

  CodingLoss loss(const SamplePlane& coded_key) {
    const PaddedPlane fine(key_, shape_.width, shape_.height, pad_);
    const PaddedPlane coded(coded_key, shape_.width, shape_.height, pad_);
    int64_t blocks = 0;
    int64_t before = 0;
    int64_t well = 0;
    int64_t sum = 0;
    for (const RefinementTarget& target : task_.targets) {
      for_each_block([&](const Area& area, int32_t disparity) {
        const SubpelVector v = vector(disparity, task_.key, target.at);
        predict({displaced(fine, area.x, area.y, v)}, 1, area, one_);
        predict({displaced(coded, area.x, area.y, v)}, 1, area, both_);
        for (int32_t y = 0; y < area.height; y += kSquare) {
          for (int32_t x = 0; x < area.width; x += kSquare) {
            const int32_t least = energy(target.planes[plane_], area, x, y, one_);
            ++blocks;
            before += std::min(least, kWellPredicted);
            if (least > kWellPredicted) continue;
            ++well;
            sum += energy(target.planes[plane_], area, x, y, both_) - least;
          }
        }
      });
    }
    const auto mean = [](int64_t energies, int64_t count) {
      return static_cast<double>(energies) / static_cast<double>(count * kSquare * kSquare);
    };
    return {mean(before, blocks), static_cast<double>(well) / static_cast<double>(blocks),
            well > 0 ? mean(sum, well) : 0};
  }

 private:
  static constexpr int32_t kSquare = 4;
  // The energy of a square in a prediction that misses: what is seen elsewhere, or hidden.
  static constexpr int32_t kWellPredicted = 2600;
  static constexpr int32_t kMaxBlock = 32;
  static constexpr int32_t kWeight = 16;   // of a sample that is predicted from one reference
  static constexpr int64_t kTapSum = 64;   // of tap_weights()
  static constexpr int kFractionBits = 4;  // of samples between two steps

  using Predicted = std::array<int16_t, size_t{kMaxBlock} * kMaxBlock>;

  // Errors and weights of one grid block, with a border of zeros of one sample.
  struct BlockErrors {
    static constexpr int32_t kStride = kMaxBlock + 2;
    std::array<int32_t, size_t{kStride} * kStride> errors{};
    std::array<int32_t, size_t{kStride} * kStride> weights{};
  };

  // Of row y, column x >= 0 in a block of `stride` columns.
  static constexpr size_t place(int32_t x, int32_t y, int32_t stride) {
    return static_cast<size_t>(y) * static_cast<size_t>(stride) + static_cast<size_t>(x);
  }

  // In a plane with padding.
  size_t index(int64_t x, int64_t y) const {
    return static_cast<size_t>((y + pad_) * stride_ + x + pad_);
  }

  // The squared error of the key image against its view.
  int64_t own_error() const {
    int64_t sum = 0;
    for (size_t k = 0; k < key_.samples.size(); ++k) {
      const int64_t error = key_.samples[k] - view_.samples[k];
      sum += error * error;
    }
    return sum;
  }

  // Calls work(area, disparity) for each grid block.
  template <typename Work>
  void for_each_block(const Work& work) const {
    for (uint32_t gy = 0; gy < task_.grid.blocks_y; ++gy) {
      Area area;
      area.y = static_cast<int32_t>(gy) * block_size_;
      area.height = std::min(block_size_, static_cast<int32_t>(shape_.height) - area.y);
      for (uint32_t gx = 0; gx < task_.grid.blocks_x; ++gx) {
        area.x = static_cast<int32_t>(gx) * block_size_;
        area.width = std::min(block_size_, static_cast<int32_t>(shape_.width) - area.x);
        if (area.width <= 0 || area.height <= 0) continue;
        work(area, task_.grid.at(gx, gy));
      }
    }
  }

  void add(const RefinementTarget& target, const PaddedPlane& reference) {
    for_each_block([&](const Area& area, int32_t disparity) {
      add_block(target, reference, area, disparity);
    });
  }

  void add_block(const RefinementTarget& target, const PaddedPlane& reference, const Area& area,
                 int32_t disparity) {
    const SubpelVector own = vector(disparity, task_.key, target.at);
    std::array<DisplacedReference, 2> references{displaced(reference, area.x, area.y, own)};
    predict(references, 1, area, one_);
    const PaddedPlane* other = target.other_planes[plane_];
    if (other != nullptr) {
      references[1] = displaced(*other, area.x, area.y, vector(disparity, target.other, target.at));
      predict(references, 2, area, both_);
    }
    for (int32_t y = 0; y < area.height; y += kSquare) {
      for (int32_t x = 0; x < area.width; x += kSquare) {
        weigh(target.planes[plane_], area, x, y, other != nullptr);
      }
    }
    spread(area, own);
  }

  SubpelVector vector(int32_t disparity, ImagePos reference, ImagePos at) const {
    const MotionVector full =
        disparity_vector(disparity, row_offset(reference, at), col_offset(reference, at), rules_);
    return subpel_vector(full, task_.header.vector_precision, halved_);
  }

  void predict(const std::array<DisplacedReference, 2>& references, unsigned count,
               const Area& area, Predicted& out) const {
    interpolate_rect(references, count, bound_,
                     {out.data(), kMaxBlock, static_cast<unsigned>(area.width),
                      static_cast<unsigned>(area.height)});
  }

  // Of the 4x4 samples from (x, y) of the grid block on.
  static int32_t energy(const SamplePlane& target, const Area& area, int32_t x, int32_t y,
                        const Predicted& predicted) {
    int32_t sum = 0;
    for (int32_t j = y; j < std::min(y + kSquare, area.height); ++j) {
      const int16_t* row = target.row(static_cast<uint32_t>(area.y + j)).data() + area.x;
      for (int32_t i = x; i < std::min(x + kSquare, area.width); ++i) {
        const int32_t error = row[i] - predicted[place(i, j, kMaxBlock)];
        sum += error * error;
      }
    }
    return sum;
  }

  // Errors and weights of the 4x4 samples from (x, y) of the grid block on, with the better
  // prediction.
  void weigh(const SamplePlane& target, const Area& area, int32_t x, int32_t y, bool two) {
    const int32_t energy_of_one = energy(target, area, x, y, one_);
    const int32_t energy_of_both = two ? energy(target, area, x, y, both_) : 0;
    two = two && energy_of_both < energy_of_one;
    const int64_t least = two ? energy_of_both : energy_of_one;
    left_ += estimate_(least);
    const auto weight = static_cast<int32_t>(estimate_.slope(least, two ? kWeight / 2 : kWeight));
    const Predicted& predicted = two ? both_ : one_;
    const int32_t x1 = std::min(x + kSquare, area.width);
    const int32_t y1 = std::min(y + kSquare, area.height);
    for (int32_t j = y; j < y1; ++j) {
      const int16_t* row = target.row(static_cast<uint32_t>(area.y + j)).data() + area.x;
      for (int32_t i = x; i < x1; ++i) {
        const size_t to = place(i + 1, j + 1, BlockErrors::kStride);
        errors_here_.errors[to] = weight * (row[i] - predicted[place(i, j, kMaxBlock)]);
        errors_here_.weights[to] = weight;
      }
    }
  }

  // Adds the grid block to the samples of the key image that it is interpolated from.
  void spread(const Area& area, const SubpelVector& v) {
    const TapWeights taps = tap_weights(v.fx, v.fy);
    const int32_t columns = area.width + (v.fx > 0 ? 1 : 0);
    const int32_t rows = area.height + (v.fy > 0 ? 1 : 0);
    clear_border(area);
    for (int32_t j = 0; j < rows; ++j) {
      const size_t to = index(area.x + v.ix, area.y + v.iy + j);
      const size_t from = place(0, j, BlockErrors::kStride);
      add_row(&errors_here_.errors[from], taps, columns, &errors_[to]);
      add_row(&errors_here_.weights[from], taps, columns, &weights_[to]);
    }
  }

  // The grid block before may have been larger.
  void clear_border(const Area& area) {
    for (int32_t i = 0; i <= area.width + 1; ++i) {
      const size_t at = place(i, area.height + 1, BlockErrors::kStride);
      errors_here_.errors[at] = errors_here_.weights[at] = 0;
    }
    for (int32_t j = 0; j <= area.height; ++j) {
      const size_t at = place(area.width + 1, j, BlockErrors::kStride);
      errors_here_.errors[at] = errors_here_.weights[at] = 0;
    }
  }

  // `above`: the row above, from one column to the left on.
  static void add_row(const int32_t* above, const TapWeights& taps, int32_t columns, int64_t* out) {
    const int32_t* here = above + BlockErrors::kStride;
    for (int32_t i = 0; i < columns; ++i) {
      out[i] +=
          taps[0] * here[i + 1] + taps[1] * here[i] + taps[2] * above[i + 1] + taps[3] * above[i];
    }
  }

  // One step: each sample of the key image by the mean of the errors that it has a part in.
  void move() {
    for (uint32_t y = 0; y < shape_.height; ++y) {
      for (uint32_t x = 0; x < shape_.width; ++x) {
        const size_t k = size_t{y} * key_.width + x;
        const size_t from = index(x, y);
        const int64_t own = int64_t{view_.samples[k]} * (1 << kFractionBits) - fine_[k];
        const int64_t error = own_weight_ * own + errors_[from] * (1 << kFractionBits);
        fine_[k] += round_half_up_div(error, own_weight_ + weights_[from]);
        key_.samples[k] =
            static_cast<int16_t>(clamp(round_shift(fine_[k], kFractionBits), range_.lo, range_.hi));
      }
    }
    key_ = in_whole_blocks(cropped(key_, shape_.width, shape_.height), shape_,
                           task_.geometry.block_size());
  }

  const KeyRefinement& task_;
  size_t plane_;
  SamplePlane& key_;
  SamplePlane view_;
  const PlaneShape& shape_;
  bool halved_;
  int32_t block_size_;
  int pad_;
  ptrdiff_t stride_;
  SampleRange range_;
  int32_t bound_;
  VectorRules rules_;
  ResidualEstimate estimate_;
  int64_t own_weight_;
  int64_t left_ = 0;              // of the targets, with the key image at hand
  std::vector<int32_t> fine_;     // samples of the key image with their fraction
  std::vector<int64_t> errors_;   // sums of taps * weight * error, of a plane with padding
  std::vector<int64_t> weights_;  // sums of taps * weight
  Predicted one_{};
  Predicted both_{};
  BlockErrors errors_here_;
};

}  // namespace

void refine_key(const KeyRefinement& task, ImagePlanes& key) {
  if (task.targets.empty()) return;
  parallel_for(kPlaneCount, [&](size_t p) { PlaneRefinement(task, p, key[p]).run(); });
}

CodingLoss coding_loss(const KeyRefinement& task, Plane plane, const SamplePlane& fine,
                       const SamplePlane& coded) {
  SamplePlane key = fine;
  return PlaneRefinement(task, static_cast<size_t>(plane), key).loss(coded);
}

}  // namespace hmlfc
