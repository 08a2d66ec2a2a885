#include "accuracy/frame_errors.hpp"

#include <algorithm>
#include <cmath>

#include "common/program.hpp"

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

const RealFrame& FrameComparison::real(From from, Filter filter, int stop_level) {
  const auto [found, first] = frames_.try_emplace({from, filter, stop_level});
  if (first) {
    camera_.filter = filter;
    const Decoder& decoder = from == From::kStream ? stream_ : source_;
    found->second = value_of(render_real(decoder, camera_, stop_level));
  }
  return found->second;
}

FrameErrors FrameComparison::errors(const RgbImage& image, Filter filter, int stop_level) {
  const RealFrame& best = real(From::kSource, Filter::kQuadrilinear, 0);
  const RealFrame& coded = real(From::kStream, Filter::kQuadrilinear, stop_level);
  const RealFrame& filtered = real(From::kSource, filter, 0);
  const RealFrame& own = real(From::kStream, filter, stop_level);
  return {.total = mean_squared_error(image, best),
          .stream = mean_squared_difference(coded, best),
          .filter = mean_squared_difference(filtered, best),
          .fixed = mean_squared_error(image, own),
          .largest_fixed = largest_difference(image, own)};
}

}  // namespace hmlfc::bench
