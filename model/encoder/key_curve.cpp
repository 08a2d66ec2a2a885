#include "encoder/key_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace hmlfc {
namespace {

// The errors measured: the least, the ratio of each to the one before, their number.
constexpr double kLeastError = 0.25;
constexpr double kErrorRatio = 2;
constexpr int kErrorCount = 11;
// Errors tried between two of them.
constexpr int kParts = 16;

double mean_squared_error(const SamplePlane& a, const SamplePlane& b) {
  int64_t squares = 0;
  for (size_t i = 0; i < a.samples.size(); ++i) {
    const int64_t error = a.samples[i] - b.samples[i];
    squares += error * error;
  }
  return static_cast<double>(squares) / static_cast<double>(a.samples.size());
}

// Between a and b, which are positive, on a logarithmic scale.
double between(double a, double b, double share) { return a * std::pow(b / a, share); }

}  // namespace

KeyCurve::KeyCurve(const SamplePlane& plane, SamplePrecision precision) {
  double asked = kLeastError;
  for (int i = 0; i < kErrorCount; ++i, asked *= kErrorRatio) {
    const auto coded = encode_jpeg2000_lossy(plane, precision, asked);
    if (!coded) throw std::bad_alloc();
    const auto decoded = decode_jpeg2000(*coded, plane.width, plane.height);
    if (!decoded) throw std::bad_alloc();
    const auto samples = static_cast<double>(plane.samples.size());
    const double error = mean_squared_error(plane, *decoded);
    points_.push_back({asked, error, 8 * static_cast<double>(coded->size()) / samples});
    if (error < asked / 8) break;  // nothing is left to lose
  }
}

KeyPoint KeyCurve::cheapest(double weight, Lambda lambda) const {
  const double bit = static_cast<double>(lambda.scaled) / 256;
  KeyPoint best = points_.front();
  double least = std::numeric_limits<double>::max();
  const auto attempt = [&](const KeyPoint& point) {
    const double cost = weight * point.error + bit * point.bits;
    if (cost >= least) return;
    least = cost;
    best = point;
  };
  for (size_t i = 0; i + 1 < points_.size(); ++i) {
    const KeyPoint& a = points_[i];
    const KeyPoint& b = points_[i + 1];
    for (int part = 0; part < kParts; ++part) {
      const double share = static_cast<double>(part) / kParts;
      const double error = a.error > 0 ? between(a.error, b.error, share) : b.error * share;
      attempt({between(a.asked, b.asked, share), error, a.bits + (b.bits - a.bits) * share});
    }
  }
  attempt(points_.back());
  return best;
}

}  // namespace hmlfc
