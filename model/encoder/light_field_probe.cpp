#include "encoder/light_field_probe.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <utility>

#include "bits/parallel.hpp"
#include "encoder/cached_views.hpp"
#include "encoder/key_refinement.hpp"
#include "encoder/motion_prediction.hpp"
#include "encoder/view_planes.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {
namespace {

// The largest disparity that is looked for, in samples per view.
constexpr int32_t kMaxDisparityPerView = 12;
// The views looked at: so many rows and columns away from the middle, where the grid has them.
constexpr uint32_t kReach = 2;
// Of views in which key images are measured, at most.
constexpr uint32_t kKeyWidth = 384;
constexpr uint32_t kKeyHeight = 256;
constexpr unsigned kProbeGridLog2 = 4;
// A lambda with which no residual ever pays: squared errors count as they are.
constexpr int64_t kNoResidual = int64_t{1} << 40;
// Distances of rows of cameras, in 16ths of that of columns. One is believed that leaves this share
// of the error of 16; with the lambda of quality 84, as what nothing predicts counts little then.
constexpr std::array kRowScales{4, 5, 8, 11, 12, 13, 14, 18, 20, 21, 24, 27, 32, 48, 64};
constexpr Lambda kFineLambda{int64_t{256} << 2};
constexpr double kBelievedError = 0.95;
// Rows and columns that predict with this share of the error, exchanged, are taken for exchanged.
constexpr double kTransposedError = 0.75;
// The lambda of quality 60, and the images of a group of 5x5: what a key image costs hardly depends
// on either.
constexpr Lambda kUsualLambda{int64_t{256} << 5};
constexpr size_t kUsualImages = 24;
// Steps of the refinement of key images that are tried; 0 leaves the view. More sharpen an image
// further and cost bits; where there is noise, they take it out.
constexpr std::array kRefinementSteps{0, 2, 4};
// The squared error of 4x4 samples in a prediction that misses: what is seen elsewhere, or hidden.
constexpr uint32_t kWellPredicted = 2600;
// An error at which a part of the views is compared with the whole.
constexpr double kUsualError = 2;
// The share of a key image's error that is left in what is interpolated from it, where that cannot
// be measured.
constexpr double kInterpolatedError = 0.65;

ImagePos middle_of(const StreamHeader& header) { return {header.rows / 2, header.cols / 2}; }

// Those looked at along a line of `count` views.
std::vector<uint32_t> places(uint32_t count) {
  if (count == 1) return {0};
  if (count == 2) return {0, 1};
  const uint32_t reach = count > 2 * kReach ? kReach : 1;
  return {count / 2 - reach, count / 2, count / 2 + reach};
}

std::vector<ImagePos> views_around_middle(const StreamHeader& header) {
  std::vector<ImagePos> around;
  for (const uint32_t row : places(header.rows)) {
    for (const uint32_t col : places(header.cols)) {
      if (ImagePos{row, col} != middle_of(header)) around.push_back({row, col});
    }
  }
  return around;
}

class DisparityProbe {
 public:
  DisparityProbe(const ViewProvider& views, const StreamHeader& header)
      : header_(header),
        reference_(view_planes(views, Geometry(header), middle_of(header))[0], header.width,
                   header.height, header.window + 10) {
    for (const ImagePos at : views_around_middle(header)) {
      const int32_t rows = row_offset(middle_of(header), at);
      const int32_t cols = col_offset(middle_of(header), at);
      farthest_ = std::max({farthest_, std::abs(rows), std::abs(cols)});
      targets_.push_back({nullptr, {nullptr, rows, cols}, {}});
      planes_.push_back(view_planes(views, Geometry(header), at)[0]);
    }
  }

  // As if the grid's rows were its columns.
  void transpose() {
    for (SearchTarget& target : targets_)
      std::swap(target.first.row_offset, target.first.col_offset);
  }

  // Of all blocks, as far as the limit allows.
  CoarseResult range(int row_scale) const {
    return search(row_scale, {kNoResidual}, kProbeGridLog2, 2);
  }

  // The row scale with the sign of `usual` that leaves the least error, if it is less than usual.
  int row_scale(int usual) const {
    const auto error = [&](int scale) {
      return static_cast<double>(search(scale, kFineLambda, 3, 8).error);
    };
    int best = usual;
    double least = kBelievedError * error(usual);
    for (const int scale : kRowScales) {
      const double here = error(usual < 0 ? -scale : scale);
      if (here >= least) continue;
      least = here;
      best = usual < 0 ? -scale : scale;
    }
    return best;
  }

 private:
  CoarseResult search(int row_scale, Lambda lambda, unsigned grid_log2, uint32_t rows_apart) const {
    StreamHeader header = header_;
    header.row_scale = row_scale;
    header.disparity_grid_log2 = grid_log2;
    DisparitySearch search(header);
    search.targets = targets_;
    for (size_t i = 0; i < planes_.size(); ++i) {
      search.targets[i].plane = &planes_[i];
      search.targets[i].first.plane = &reference_;
    }
    search.lambda = lambda;
    search.rows_apart = rows_apart;
    const int32_t limit = std::min(kMaxDisparityPerView, std::max(1, header_.window / farthest_));
    return coarse_disparities(search, limit << header_.disparity_precision);
  }

  const StreamHeader& header_;
  PaddedPlane reference_;
  std::vector<SearchTarget> targets_;
  std::vector<SamplePlane> planes_;
  int32_t farthest_ = 1;
};

// The view in the middle as a key image of a usual group, and the views around it.
class KeyProbe : public std::enable_shared_from_this<KeyProbe> {
 public:
  KeyProbe(const ViewProvider& views, const StreamHeader& header, const DisparityRange& range)
      : header_(header),
        geometry_(header),
        middle_(middle_of(header)),
        view_(view_planes(views, geometry_, middle_)) {
    if (header.has(Feature::kSharedDisparity)) find_targets(views, range);
  }

  // The curves of the view, refined for the views around it in different numbers of steps. They
  // share this.
  std::array<std::vector<KeyCurve>, kPlaneCount> curves() const {
    std::array<std::vector<KeyCurve>, kPlaneCount> curves;
    ImagePlanes before;
    for (const int steps : kRefinementSteps) {
      if (targets_.empty() && steps > 0) break;
      ImagePlanes key = view_;
      if (steps > 0) refine_key(task(steps), key);
      for (size_t p = 0; p < kPlaneCount; ++p) {
        // A refinement that has ended is not measured twice.
        if (curves[p].size() > 1 && key[p].samples == before[p].samples) continue;
        const PlaneShape& shape = geometry_.plane(kPlanes[p]);
        const SamplePlane inside = cropped(key[p], shape.width, shape.height);
        std::vector<uint32_t> squares = prediction_errors(task(steps), kPlanes[p], key[p]);
        const auto measure = [self = shared_from_this(), p, inside,
                              squares = std::move(squares)](const SamplePlane& coded) {
          return self->errors(p, inside, squares, coded);
        };
        curves[p].emplace_back(inside, steps, precision_of(kPlanes[p], header_.depth), measure);
      }
      before = std::move(key);
    }
    return curves;
  }

 private:
  void find_targets(const ViewProvider& views, const DisparityRange& disparities) {
    const PaddedPlane reference(view_[0], header_.width, header_.height, header_.window + 10);
    DisparitySearch search(header_);
    search.lambda = kUsualLambda;
    for (const ImagePos at : views_around_middle(header_)) {
      targets_.push_back({view_planes(views, geometry_, at), at, {}, {}});
      search.targets.push_back(
          {nullptr, {&reference, row_offset(middle_, at), col_offset(middle_, at)}, {}});
    }
    if (targets_.empty()) return;
    for (size_t i = 0; i < targets_.size(); ++i) search.targets[i].plane = &targets_[i].planes[0];
    search.images = std::max(targets_.size(), kUsualImages);
    grid_ = search_disparities(search, disparities);
  }

  KeyRefinement task(int steps) const {
    constexpr std::array kLambdas{kUsualLambda, kUsualLambda, kUsualLambda};
    const size_t images = std::max(targets_.size(), kUsualImages);
    return {header_, geometry_, middle_, grid_, targets_, images, kLambdas, {steps, steps, steps}};
  }

  // What coding makes of plane p of `key`, from which predictions have the errors `squares`.
  KeyErrors errors(size_t p, const SamplePlane& key, const std::vector<uint32_t>& squares,
                   const SamplePlane& coded) const {
    const PlaneShape& shape = geometry_.plane(kPlanes[p]);
    const double own = mean_squared_error(cropped(view_[p], shape.width, shape.height), coded);
    const double interpolated = kInterpolatedError * mean_squared_error(key, coded);
    if (squares.empty()) return {own, interpolated};
    const std::vector<uint32_t> of_coded = prediction_errors(
        task(0), kPlanes[p], in_whole_blocks(coded, shape, geometry_.block_size()));
    int64_t before = 0;  // what is predicted badly counts as bounded
    int64_t lost = 0;    // by coding, where predictions are good
    double well = 0;
    for (size_t k = 0; k < squares.size(); ++k) {
      before += std::min(squares[k], kWellPredicted);
      if (squares[k] > kWellPredicted) continue;
      lost += int64_t{of_coded[k]} - squares[k];
      ++well;
    }
    const auto all = static_cast<double>(squares.size());
    return {own, static_cast<double>(before + lost) / (16 * all) + (1 - well / all) * interpolated};
  }

  StreamHeader header_;
  Geometry geometry_;
  ImagePos middle_;
  ImagePlanes view_;
  std::vector<RefinementTarget> targets_;
  DisparityGrid grid_;
};

}  // namespace

bool seems_transposed(const ViewProvider& views, const StreamHeader& header) {
  if (header.rows == 1 || header.cols == 1) return false;
  DisparityProbe probe(views, header);
  const auto error = [&] {
    return static_cast<double>(std::min(probe.range(-16).error, probe.range(16).error));
  };
  const double as_it_is = error();
  probe.transpose();
  return error() < kTransposedError * as_it_is;
}

std::vector<int> likely_row_scales(const ViewProvider& views, const StreamHeader& header) {
  if (!header.has(Feature::kSharedDisparity) || header.rows == 1) return {16};
  const DisparityProbe probe(views, header);
  const int usual = probe.range(-16).error < probe.range(16).error ? -16 : 16;
  const int likely = header.cols == 1 ? usual : probe.row_scale(usual);
  return likely == usual ? std::vector{usual} : std::vector{usual, likely};
}

LightFieldProbe probe_light_field(const ViewProvider& views, const StreamHeader& header,
                                  int row_scale) {
  LightFieldProbe found;
  found.row_scale = row_scale;
  if (header.has(Feature::kSharedDisparity)) {
    found.disparities = DisparityProbe(views, header).range(row_scale).range;
  }
  const bool lossy = header.has(Feature::kLossyKeys);
  if (lossy) {
    StreamHeader of_part = header;
    of_part.width = std::min(header.width, kKeyWidth);
    of_part.height = std::min(header.height, kKeyHeight);
    of_part.row_scale = found.row_scale;
    const CachedViews part(views,
                           {(header.width - of_part.width) / 2,
                            (header.height - of_part.height) / 2, of_part.width, of_part.height},
                           0);
    found.keys = std::make_shared<KeyProbe>(part, of_part, found.disparities)->curves();
  }
  const Geometry geometry(header);
  const ImagePlanes whole = view_planes(views, geometry, middle_of(header));
  parallel_for(kPlaneCount, [&](size_t p) {
    const PlaneShape& shape = geometry.plane(kPlanes[p]);
    const SamplePlane inside = cropped(whole[p], shape.width, shape.height);
    const SamplePrecision precision = precision_of(kPlanes[p], header.depth);
    if (lossy) {
      found.key_bits[p] = KeyCurve(inside, 0, precision, {}).bits(kUsualError) /
                          found.keys[p].front().bits(kUsualError);
    } else {
      const CodedPlane coded = code_key_plane(inside, precision, 0);
      found.key_bits[p] = 8 * static_cast<double>(coded.codestream.size()) /
                          static_cast<double>(inside.samples.size());
    }
  });
  return found;
}

}  // namespace hmlfc
