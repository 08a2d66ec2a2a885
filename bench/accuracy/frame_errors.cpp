#include "accuracy/frame_errors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hmlfc::bench {
namespace {

double mean_squared_difference(const RealFrame& a, const RealFrame& b) {
  double sum = 0;
  for (size_t i = 0; i < a.samples.size(); ++i) {
    const double difference = a.samples[i] - b.samples[i];
    sum += difference * difference;
  }
  return sum / static_cast<double>(a.samples.size());
}

double largest_difference(const RgbImage& frame, const RealFrame& real) {
  double largest = 0;
  for (size_t i = 0; i < real.samples.size(); ++i) {
    largest = std::max(largest, std::abs(frame.samples[i] - real.samples[i]));
  }
  return largest;
}

}  // namespace

void FrameErrors::add(const FrameErrors& other) {
  total += other.total;
  stream += other.stream;
  filter += other.filter;
  fixed += other.fixed;
  largest_fixed = std::max(largest_fixed, other.largest_fixed);
}

Result<const RealFrame*> FrameComparison::real(From from, Filter filter, int stop_level) {
  const auto key = std::make_tuple(from, filter, stop_level);
  const auto found = frames_.find(key);
  if (found != frames_.end()) return &found->second;
  camera_.filter = filter;
  auto drawn = render_real(from == From::kStream ? stream_ : source_, camera_, stop_level);
  if (!drawn) return tl::unexpected(drawn.error());
  return &frames_.emplace(key, std::move(*drawn)).first->second;
}

Result<FrameErrors> FrameComparison::errors(const RgbImage& image, Filter filter, int stop_level) {
  const auto best = real(From::kSource, Filter::kQuadrilinear, 0);
  if (!best) return tl::unexpected(best.error());
  const auto coded = real(From::kStream, Filter::kQuadrilinear, stop_level);
  if (!coded) return tl::unexpected(coded.error());
  const auto filtered = real(From::kSource, filter, 0);
  if (!filtered) return tl::unexpected(filtered.error());
  const auto own = real(From::kStream, filter, stop_level);
  if (!own) return tl::unexpected(own.error());
  FrameErrors errors;
  errors.total = mean_squared_error(image, **best);
  errors.stream = mean_squared_difference(**coded, **best);
  errors.filter = mean_squared_difference(**filtered, **best);
  errors.fixed = mean_squared_error(image, **own);
  errors.largest_fixed = largest_difference(image, **own);
  return errors;
}

}  // namespace hmlfc::bench
