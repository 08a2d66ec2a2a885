#include "encoder/key_curve.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>
#include <utility>

namespace hmlfc {
namespace {

// The errors that may be measured: the least, and the number of those that are each the square root
// of two times the one before, for samples of 8 bits. A bit more has four times the error.
constexpr double kLeastError = 1.0 / 64;
constexpr int kErrorCount = 29;
constexpr double kFinestGuess = 12;
constexpr int kErrorsOfBit = 4;
// What OpenJPEG may leave of what is asked for; 1 to 1.4 times is usual.
constexpr double kMostExcess = 2;
// Errors tried between two of them.
constexpr int kParts = 8;

double asked_at(int point) {
  return kLeastError * (1 << point / 2) * (point % 2 == 0 ? 1 : 1.4142135623730951);
}

// Between a and b, which are positive, on a logarithmic scale.
double between(double a, double b, double share) { return a * std::pow(b / a, share); }

}  // namespace

int64_t squared_error(const SamplePlane& a, const SamplePlane& b) {
  return std::transform_reduce(a.samples.begin(), a.samples.end(), b.samples.begin(), int64_t{0},
                               std::plus<>(),
                               [](int32_t x, int32_t y) { return int64_t{x - y} * (x - y); });
}

double mean_squared_error(const SamplePlane& a, const SamplePlane& b) {
  return static_cast<double>(squared_error(a, b)) / static_cast<double>(a.samples.size());
}

KeyCurve::KeyCurve(SamplePlane plane, int steps, SamplePrecision precision, KeyMeasure measure)
    : plane_(std::move(plane)),
      steps_(steps),
      precision_(precision),
      error_count_(kErrorCount +
                   kErrorsOfBit * (precision.bits - (precision.is_signed ? 1 : 0) - 8)),
      measure_(std::move(measure)) {}

CodedPlane code_key_plane(const SamplePlane& plane, SamplePrecision precision, double error) {
  CodestreamOptions options;
  options.mean_squared_error = error;
  auto codestream = encode_jpeg2000(plane, precision, options);
  if (!codestream) throw std::bad_alloc();
  if (error == 0) return {std::move(*codestream), plane, 0};
  auto decoded = decode_jpeg2000(*codestream, plane.width, plane.height);
  if (!decoded) throw std::bad_alloc();
  if (mean_squared_error(plane, *decoded) > kMostExcess * error) {
    const bool least = error <= kLeastError;
    CodedPlane finer = code_key_plane(plane, precision, least ? 0 : error / kMostExcess);
    if (least) finer.asked = error;
    return finer;
  }
  return {std::move(*codestream), std::move(*decoded), error};
}

double KeyCurve::bytes(int point) const {
  const auto found = bytes_.find(point);
  if (found != bytes_.end()) return found->second;
  const CodedPlane coded = code_key_plane(plane_, precision_, asked_at(point));
  return bytes_[point] = static_cast<double>(coded.codestream.size());
}

const KeyCurve::Measured& KeyCurve::measured(int point) const {
  if (const auto found = measured_.find(point); found != measured_.end()) return found->second;
  const CodedPlane coded = code_key_plane(plane_, precision_, asked_at(point));
  bytes_[point] = static_cast<double>(coded.codestream.size());
  const double bits = 8 * bytes_[point] / static_cast<double>(plane_.samples.size());
  const KeyPoint key{coded.asked, mean_squared_error(plane_, coded.decoded), bits, steps_};
  return measured_[point] = {key, measure_(coded.decoded)};
}

double KeyCurve::bits(double asked) const {
  int point = 0;
  while (point + 2 < error_count_ && asked >= asked_at(point + 1)) ++point;
  const double share = std::log2(asked / asked_at(point)) * 2;
  double size = bytes(point);
  if (share > 0) size += (bytes(point + 1) - size) * std::min(share, 1.0);
  return 8 * size / static_cast<double>(plane_.samples.size());
}

KeyCurve::Priced KeyCurve::least(double weight, Lambda lambda) const {
  const double bit = static_cast<double>(lambda.scaled) / 256;
  const auto cost = [&](const KeyPoint& point, const KeyErrors& errors) {
    return errors.own + weight * errors.predicted + bit * point.bits;
  };
  const auto cost_at = [&](int point) { return cost(measured(point).key, measured(point).errors); };
  // From about where a bit costs what it saves, but not from where errors jump to 0.
  const double guess = 2 * std::log2(bit / (2 + 1.6 * weight) / kLeastError);
  int point = static_cast<int>(std::clamp(std::round(guess), kFinestGuess, error_count_ - 1.0));
  // Beyond some error OpenJPEG leaves far more than is asked of it: nothing coarser is tried.
  const auto is_reached = [&](int at) { return measured(at).key.asked == asked_at(at); };
  while (point > 0 && !is_reached(point)) --point;
  const auto is_last = [&] {
    const KeyPoint& key = measured(point).key;
    const bool lossless = key.error < key.asked / 8;  // nothing is left to lose
    return point + 1 == error_count_ || lossless || !is_reached(point + 1);
  };
  const int first = point;
  while (!is_last() && cost_at(point + 1) < cost_at(point)) ++point;
  // Errors for which OpenJPEG keeps nothing all cost the same.
  while (point <= first && point > 0 && cost_at(point - 1) <= cost_at(point)) --point;

  Priced best{measured(point).key, cost_at(point)};
  const int end = is_last() ? point : point + 1;
  for (int i = std::max(0, point - 1); i < end; ++i) {
    const auto& [a, a_errors] = measured(i);
    const auto& [b, b_errors] = measured(i + 1);
    for (int part = 1; part < kParts; ++part) {
      const double share = static_cast<double>(part) / kParts;
      const double error = a.error > 0 ? between(a.error, b.error, share) : b.error * share;
      // The other errors are about linear in this one.
      const double grown = b.error > a.error ? (error - a.error) / (b.error - a.error) : share;
      const KeyPoint key{between(a.asked, b.asked, share), error,
                         a.bits + (b.bits - a.bits) * share, a.steps};
      const KeyErrors errors{
          a_errors.own + (b_errors.own - a_errors.own) * grown,
          a_errors.predicted + (b_errors.predicted - a_errors.predicted) * grown};
      if (cost(key, errors) < best.cost) best = {key, cost(key, errors)};
    }
  }
  return best;
}

}  // namespace hmlfc
