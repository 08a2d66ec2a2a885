#include "encoder/key_refinement.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "arithmetic/motion.hpp"
#include "arithmetic/reconstruct.hpp"
#include "arithmetic/rounding.hpp"
#include "bits/parallel.hpp"
#include "encoder/error_kernels.hpp"
#include "encoder/key_curve.hpp"
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
        static_cast<size_t>(stride_) * (shape_.height + 2 * static_cast<size_t>(pad_)) +
        kSpreadAhead;
    int64_t unrefined = 0;
    for (int step = 0; step < task_.steps[plane_]; ++step) {
      const PaddedPlane reference(key_, shape_.width, shape_.height, pad_);
      errors_.assign(size, 0);
      weights_.assign(size, 0);
      left_ = 0;
      for (const RefinementTarget& target : task_.targets) add(target, reference);
      const int64_t sum = left_ + own_weight_ * squared_error(key_, view_) / (kWeight * kTapSum);
      if (step == 0) unrefined = sum;
      if (step == 1 && sum > unrefined - unrefined / kLeastGainDivisor) {
        key_ = view_;
        return;
      }
      move();
    }
  }

  std::vector<uint32_t> squares() {
    const PaddedPlane reference(key_, shape_.width, shape_.height, pad_);
    std::vector<uint32_t> all;
    for (const RefinementTarget& target : task_.targets) {
      for_each_run([&](const Area& area, int32_t disparity) {
        const SubpelVector v = vector(disparity, task_.key, target.at);
        predict({displaced(reference, area.x, area.y, v)}, 1, area, one_);
        for (int32_t y = 0; y < area.height; y += kSquare) {
          const size_t squares = energies(target, area, y, one_, of_one_);
          all.insert(all.end(), of_one_.begin(), of_one_.begin() + static_cast<ptrdiff_t>(squares));
        }
      });
    }
    return all;
  }

 private:
  static constexpr int32_t kSquare = 4;
  static constexpr int32_t kMaxRows = 8;       // of a grid block
  static constexpr int32_t kMaxColumns = 128;  // of those worked on at once
  static constexpr int32_t kWeight = 16;       // of a sample that is predicted from one reference
  static constexpr int64_t kTapSum = 64;       // of tap_weights()
  static constexpr int kFractionBits = 4;      // of samples between two steps

  using Predicted = std::array<int16_t, size_t{kMaxColumns} * kMaxRows>;
  using Energies = std::array<uint32_t, kMaxColumns / kSquare>;

  // What is spread of one run of grid blocks.
  struct Spreading {
    static constexpr size_t kStride = kMaxColumns + 2 * kSpreadAhead;
    std::array<int32_t, kStride * kMaxRows> values{};

    int32_t* row(int32_t y) { return &values[static_cast<size_t>(y) * kStride + kSpreadAhead]; }
  };

  // In a plane with padding.
  size_t index(int64_t x, int64_t y) const {
    return static_cast<size_t>((y + pad_) * stride_ + x + pad_);
  }

  // Calls work(area, disparity) for grid blocks next to each other that have one disparity.
  template <typename Work>
  void for_each_run(const Work& work) const {
    const uint32_t most = kMaxColumns / static_cast<uint32_t>(block_size_);
    for (uint32_t gy = 0; gy < task_.grid.blocks_y; ++gy) {
      Area area;
      area.y = static_cast<int32_t>(gy) * block_size_;
      area.height = std::min(block_size_, static_cast<int32_t>(shape_.height) - area.y);
      for (uint32_t gx = 0, end = 0; gx < task_.grid.blocks_x; gx = end) {
        const int32_t disparity = task_.grid.at(gx, gy);
        while (end < std::min(gx + most, task_.grid.blocks_x) &&
               task_.grid.at(end, gy) == disparity) {
          ++end;
        }
        area.x = static_cast<int32_t>(gx) * block_size_;
        area.width =
            std::min(static_cast<int32_t>(end) * block_size_, static_cast<int32_t>(shape_.width)) -
            area.x;
        if (area.width > 0 && area.height > 0) work(area, disparity);
      }
    }
  }

  void add(const RefinementTarget& target, const PaddedPlane& reference) {
    for_each_run([&](const Area& area, int32_t disparity) {
      const SubpelVector own = vector(disparity, task_.key, target.at);
      std::array<DisplacedReference, 2> references{displaced(reference, area.x, area.y, own)};
      predict(references, 1, area, one_);
      const PaddedPlane* other = target.other_planes[plane_];
      if (other != nullptr) {
        references[1] =
            displaced(*other, area.x, area.y, vector(disparity, target.other, target.at));
        predict(references, 2, area, both_);
      }
      for (int32_t y = 0; y < area.height; y += kSquare) weigh(target, area, y, other != nullptr);
      const size_t to = index(area.x + own.ix, area.y + own.iy);
      SpreadRows rows{errors_here_.row(0),
                      Spreading::kStride,
                      static_cast<unsigned>(area.width),
                      static_cast<unsigned>(area.height),
                      own.fx,
                      own.fy};
      spread(rows, &errors_[to], static_cast<size_t>(stride_));
      rows.values = weights_here_.row(0);
      spread(rows, &weights_[to], static_cast<size_t>(stride_));
    });
  }

  SubpelVector vector(int32_t disparity, ImagePos reference, ImagePos at) const {
    const MotionVector full =
        disparity_vector(disparity, row_offset(reference, at), col_offset(reference, at), rules_);
    return subpel_vector(full, task_.header.vector_precision, halved_);
  }

  void predict(const std::array<DisplacedReference, 2>& references, unsigned count,
               const Area& area, Predicted& out) const {
    interpolate_rect(references, count, bound_,
                     {out.data(), kMaxColumns, static_cast<unsigned>(area.width),
                      static_cast<unsigned>(area.height)});
  }

  const int16_t* samples(const RefinementTarget& target, const Area& area, int32_t y) const {
    return target.planes[plane_].row(static_cast<uint32_t>(area.y + y)).data() + area.x;
  }

  // Of the squares of rows y to y + 3 of the run. Returns their number.
  size_t energies(const RefinementTarget& target, const Area& area, int32_t y,
                  const Predicted& predicted, Energies& out) const {
    const auto columns = static_cast<unsigned>(area.width);
    square_errors({samples(target, area, y), target.planes[plane_].width, kMaxColumns, columns,
                   static_cast<unsigned>(std::min(kSquare, area.height - y))},
                  &predicted[static_cast<size_t>(y * kMaxColumns)], out.data());
    return ceil_div(columns, unsigned{kSquare});
  }

  // Errors and weights of rows y to y + 3 of the run, with the better prediction of each square.
  void weigh(const RefinementTarget& target, const Area& area, int32_t y, bool two) {
    const size_t squares = energies(target, area, y, one_, of_one_);
    if (two) energies(target, area, y, both_, of_both_);
    const int32_t end = std::min(y + kSquare, area.height);
    for (size_t k = 0; k < squares; ++k) {
      const bool better = two && of_both_[k] < of_one_[k];
      const int64_t least = better ? of_both_[k] : of_one_[k];
      left_ += estimate_(least);
      const int64_t weight = estimate_.slope(least, better ? kWeight / 2 : kWeight);
      std::fill_n(&sample_weights_[k * kSquare], kSquare, static_cast<int16_t>(weight));
      for (int32_t j = y; better && j < end; ++j) {
        const size_t at = static_cast<size_t>(j * kMaxColumns) + k * kSquare;
        std::copy_n(&both_[at], kSquare, &one_[at]);
      }
    }
    for (int32_t j = y; j < end; ++j) {
      const int16_t* here = samples(target, area, j);
      const int16_t* predicted = &one_[static_cast<size_t>(j * kMaxColumns)];
      int32_t* errors = errors_here_.row(j);
      int32_t* weights = weights_here_.row(j);
      for (int32_t i = 0; i < area.width; ++i) {
        const int16_t weight = sample_weights_[static_cast<size_t>(i)];
        errors[i] = weight * static_cast<int16_t>(here[i] - predicted[i]);
        weights[i] = weight;
      }
      std::fill_n(errors + area.width, kSpreadAhead, 0);
      std::fill_n(weights + area.width, kSpreadAhead, 0);
    }
  }

  // One step: each sample of the key image by the mean of the errors that it has a part in.
  void move() {
    for (uint32_t y = 0; y < shape_.height; ++y) {
      for (uint32_t x = 0; x < shape_.width; ++x) {
        const size_t k = size_t{y} * key_.width + x;
        const size_t from = index(x, y);
        const int64_t own = int64_t{view_.samples[k]} * (1 << kFractionBits) - fine_[k];
        const int64_t error = own_weight_ * own + int64_t{errors_[from]} * (1 << kFractionBits);
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
  int64_t left_ = 0;           // of the targets, with the key image at hand
  std::vector<int32_t> fine_;  // samples of the key image with their fraction
  // Of a plane with padding, which spread() may exceed. Large errors have small weights: a target
  // adds at most 10^6 times the grid blocks that overlap.
  std::vector<int32_t> errors_;   // sums of taps * weight * error
  std::vector<int32_t> weights_;  // sums of taps * weight
  Predicted one_{};
  Predicted both_{};
  Energies of_one_{};
  Energies of_both_{};
  std::array<int16_t, kMaxColumns> sample_weights_{};
  Spreading errors_here_;
  Spreading weights_here_;
};

}  // namespace

void refine_key(const KeyRefinement& task, ImagePlanes& key) {
  if (task.targets.empty()) return;
  parallel_for(kPlaneCount, [&](size_t p) { PlaneRefinement(task, p, key[p]).run(); });
}

std::vector<uint32_t> prediction_errors(const KeyRefinement& task, Plane plane,
                                        const SamplePlane& key) {
  SamplePlane same = key;
  return PlaneRefinement(task, static_cast<size_t>(plane), same).squares();
}

}  // namespace hmlfc
