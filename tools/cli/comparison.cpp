#include "cli/comparison.hpp"

#include <algorithm>
#include <mutex>

#include <hmlfc/measure.hpp>

#include "cli/for_each_view.hpp"
#include "cli/output.hpp"

namespace hmlfc::cli {

namespace {

// The part of `image` that lies in `rect`.
RgbImage cropped(const RgbImage& image, const Rect& rect) {
  RgbImage part{rect.width, rect.height, image.depth, {}};
  part.samples.reserve(size_t{rect.width} * rect.height * 3);
  for (uint32_t y = rect.y; y < rect.y + rect.height; ++y) {
    const uint16_t* row = image.samples.data() + (size_t{y} * image.width + rect.x) * 3;
    part.samples.insert(part.samples.end(), row, row + size_t{rect.width} * 3);
  }
  return part;
}

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

// Adds up views; the result does not depend on their order.
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

Quality quality_of(const ErrorSums& sums, const LightFieldShape& shape) {
  const uint64_t pixels = uint64_t{shape.rows} * shape.cols * shape.width * shape.height;
  return {psnr(sums.rgb_squares, pixels * 3, shape.depth),
          psnr(sums.y_squares, pixels, shape.depth), sums.max_abs};
}

ErrorSums measure_stream(const StreamFile& file, const LightField& original, int threads,
                         const io::Progress& progress) {
  const size_t count = size_t{original.shape().rows} * original.shape().cols;
  std::mutex mutex;
  ErrorSums sums;
  size_t done = 0;
  const auto add_view = [&](ViewPos at, RgbImage&& decoded) {
    const ErrorSums error = measure(original.view(at.row, at.col), decoded);
    const std::scoped_lock lock(mutex);
    sums.add(error);
    if (progress) progress(++done, count);
  };
  file.value(file.decoder().decode_all(add_view, {.threads = threads}));
  return sums;
}

Comparison compare(const ViewSource& a, const ViewSource& b, const ComparedPart& part,
                   const io::Progress& progress) {
  LightFieldShape shape = a.shape();
  if (shape != b.shape()) {
    throw Failure(ExitCode::kInput, "The light fields differ in shape: " + describe(shape) +
                                        " versus " + describe(b.shape()));
  }
  if (part.view) a.check_view(*part.view);
  if (part.rect) check_rect(*part.rect, shape);
  Collector collector;
  const auto add = [&](ViewPos view) {
    if (!part.rect) return collector.add(view, a.view(view), b.view(view));
    collector.add(view, cropped(a.view(view), *part.rect), cropped(b.view(view), *part.rect));
  };
  if (part.view) {
    add(*part.view);
    shape.rows = shape.cols = 1;
  } else {
    for_each_view({shape.rows, shape.cols}, 0, progress, add);
  }
  if (part.rect) {
    shape.width = part.rect->width;
    shape.height = part.rect->height;
  }
  Comparison comparison = collector.result(shape);
  if (part.rect && comparison.first_difference) {
    comparison.first_difference->x += part.rect->x;
    comparison.first_difference->y += part.rect->y;
  }
  return comparison;
}

}  // namespace hmlfc::cli
