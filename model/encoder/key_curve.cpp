#include "encoder/key_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace hmlfc {
namespace {

// The errors measured: the least, the ratio of each to the one before, their number.
constexpr double kLeastError = 0.25;
constexpr double kErrorRatio = 1.4142135623730951;
constexpr int kErrorCount = 21;
// Errors tried between two of them.
constexpr int kParts = 8;

// Between a and b, which are positive, on a logarithmic scale.
double between(double a, double b, double share) { return a * std::pow(b / a, share); }

}  // namespace

double mean_squared_error(const SamplePlane& a, const SamplePlane& b) {
  int64_t squares = 0;
  for (size_t i = 0; i < a.samples.size(); ++i) {
    const int64_t error = a.samples[i] - b.samples[i];
    squares += error * error;
  }
  return static_cast<double>(squares) / static_cast<double>(a.samples.size());
}

KeyCurve::KeyCurve(const SamplePlane& plane, int steps, SamplePrecision precision,
                   const KeyMeasure& measure) {
  double asked = kLeastError;
  for (int i = 0; i < kErrorCount; ++i, asked *= kErrorRatio) {
    const auto coded = encode_jpeg2000_lossy(plane, precision, asked);
    if (!coded) throw std::bad_alloc();
    const auto decoded = decode_jpeg2000(*coded, plane.width, plane.height);
    if (!decoded) throw std::bad_alloc();
    const auto samples = static_cast<double>(plane.samples.size());
    const double error = mean_squared_error(plane, *decoded);
    points_.push_back({{asked, error, 8 * static_cast<double>(coded->size()) / samples, steps},
                       measure(*decoded)});
    if (error < asked / 8) break;  // nothing is left to lose
  }
}

double KeyCurve::bits(double asked) const {
  for (size_t i = 1; i < points_.size(); ++i) {
    const KeyPoint& a = points_[i - 1].key;
    const KeyPoint& b = points_[i].key;
    if (asked >= b.asked) continue;
    const double share = std::log(asked / a.asked) / std::log(b.asked / a.asked);
    return a.bits + (b.bits - a.bits) * std::max(0.0, share);
  }
  return points_.back().key.bits;
}

KeyCurve::Priced KeyCurve::least(double weight, Lambda lambda) const {
  const double bit = static_cast<double>(lambda.scaled) / 256;
  Priced best{points_.front().key, std::numeric_limits<double>::max()};
  const auto attempt = [&](const KeyPoint& point, double own, double predicted) {
    const double cost = own + weight * predicted + bit * point.bits;
    if (cost < best.cost) best = {point, cost};
  };
  for (size_t i = 0; i + 1 < points_.size(); ++i) {
    const auto& [a, a_errors] = points_[i];
    const auto& [b, b_errors] = points_[i + 1];
    for (int part = 0; part < kParts; ++part) {
      const double share = static_cast<double>(part) / kParts;
      const double error = a.error > 0 ? between(a.error, b.error, share) : b.error * share;
      // The other errors are about linear in this one.
      const double grown = b.error > a.error ? (error - a.error) / (b.error - a.error) : share;
      attempt(
          {between(a.asked, b.asked, share), error, a.bits + (b.bits - a.bits) * share, a.steps},
          a_errors.own + (b_errors.own - a_errors.own) * grown,
          a_errors.predicted + (b_errors.predicted - a_errors.predicted) * grown);
    }
  }
  const auto& [last, errors] = points_.back();
  attempt(last, errors.own, errors.predicted);
  return best;
}

}  // namespace hmlfc
