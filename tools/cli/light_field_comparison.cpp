#include "cli/light_field_comparison.hpp"

#include <algorithm>
#include <mutex>

#include <hmlfc/measure.hpp>

#include "cli/for_each_view.hpp"

namespace hmlfc::cli {
namespace {

Difference first_difference(ViewPos view, const RgbImage& a, const RgbImage& b) {
  const auto [in_a, in_b] = std::mismatch(a.samples.begin(), a.samples.end(), b.samples.begin());
  const auto index = static_cast<size_t>(in_a - a.samples.begin());
  const size_t pixel = index / 3;
  return {view,
          static_cast<uint32_t>(pixel % a.width),
          static_cast<uint32_t>(pixel / a.width),
          static_cast<uint32_t>(index % 3),
          *in_a,
          *in_b};
}

bool is_before(ViewPos a, ViewPos b) { return a.row != b.row ? a.row < b.row : a.col < b.col; }

// Adds views in any order; the result does not depend on it.
class Collector {
 public:
  void add(ViewPos view, const RgbImage& a, const RgbImage& b) {
    const ErrorSums sums = measure(a, b);
    const std::scoped_lock lock(mutex_);
    total_.add(sums);
    if (!worst_ || sums.rgb_squares > worst_->squares ||
        (sums.rgb_squares == worst_->squares && is_before(view, worst_->view))) {
      worst_ = Worst{view, sums.rgb_squares};
    }
    if (sums.max_abs > 0 && (!first_ || is_before(view, first_->view))) {
      first_ = first_difference(view, a, b);
    }
  }

  Comparison result(const LightFieldShape& shape) const {
    const uint64_t view_samples = uint64_t{shape.width} * shape.height * 3;
    return {quality_of(total_, shape), psnr(worst_->squares, view_samples, shape.depth),
            worst_->view, first_};
  }

 private:
  struct Worst {
    ViewPos view;
    uint64_t squares = 0;
  };

  std::mutex mutex_;
  ErrorSums total_;
  std::optional<Worst> worst_;
  std::optional<Difference> first_;
};

}  // namespace

Comparison compare(const ViewSource& a, const ViewSource& b, const io::Progress& progress) {
  const LightFieldShape& shape = a.shape();
  if (shape != b.shape()) {
    throw Failure(ExitCode::kInput, "The light fields differ in shape: " + describe(shape) +
                                        " against " + describe(b.shape()));
  }
  Collector collector;
  for_each_view({shape.rows, shape.cols}, 0, progress,
                [&](ViewPos view) { collector.add(view, a.view(view), b.view(view)); });
  return collector.result(shape);
}

}  // namespace hmlfc::cli
