#include "encoder/key_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <numeric>
#include <utility>

namespace hmlfc {
namespace {

// The errors that may be measured: the least, and the number of those that are each the square root
// of two times the one before, for samples of 8 bits. A bit more has four times the error.
constexpr double kLeastError = 1.0 / 64;
constexpr float kErrorDb = 1.5051F;  // the square root of two
constexpr int kErrorCount = 29;
constexpr double kFinestGuess = 12;
constexpr int kErrorsOfBit = 4;
// What OpenJPEG may leave of what is asked for; 1 to 1.4 times is usual.
constexpr double kMostExcess = 2;
// Errors tried between two of them.
constexpr int kParts = 8;
// Errors measured by one codestream, each a layer of it.
constexpr int kLayers = 12;

size_t layer_of(int point) { return static_cast<size_t>(kLayers - 1 - point % kLayers); }

double asked_at(int point) {
  return kLeastError * (1 << point / 2) * (point % 2 == 0 ? 1 : 1.4142135623730951);
}

// Between a and b, which are positive, on a logarithmic scale.
double between(double a, double b, double share) { return a * std::pow(b / a, share); }

// About the bits of each of `samples` that the first 1, 2, ... of kLayers layers would take as one.
// Each packet, one for a layer of a resolution, begins with SOP and a header of a byte or more.
std::vector<double> bits_of_layers(const std::vector<uint8_t>& codestream, size_t samples) {
  constexpr std::array<uint8_t, 4> kSodSop{0xFF, 0x93, 0xFF, 0x91};
  constexpr size_t kSopBytes = 6;
  constexpr size_t kEocBytes = 2;
  constexpr double kAsOne = 0.988;  // of what longer headers leave; on light fields 0.98 to 1
  auto at = std::search(codestream.begin(), codestream.end(), kSodSop.begin(), kSodSop.end());
  std::vector<size_t> packets;
  while (at != codestream.end()) {
    at = std::search(at + 2, codestream.end(), kSodSop.begin() + 2, kSodSop.end());
    packets.push_back(static_cast<size_t>(at - codestream.begin()));
  }
  packets.back() -= kEocBytes;
  const size_t resolutions = packets.size() / kLayers;
  std::vector<double> bits;
  for (size_t n = resolutions; n < packets.size(); n += resolutions) {
    const size_t bytes = packets[n] - n * (kSopBytes + 1) + resolutions + kEocBytes;
    bits.push_back(8 * kAsOne * static_cast<double>(bytes) / static_cast<double>(samples));
  }
  return bits;
}

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
  if (error == 0) return {std::move(*codestream), plane};
  auto decoded = decode_jpeg2000(*codestream, plane.width, plane.height);
  if (!decoded) throw std::bad_alloc();
  if (mean_squared_error(plane, *decoded) > kMostExcess * error) {
    return code_key_plane(plane, precision, error <= kLeastError ? 0 : error / kMostExcess);
  }
  return {std::move(*codestream), std::move(*decoded)};
}

const KeyCurve::Coded& KeyCurve::coded(int point) const {
  Coded& coded = coded_[point / kLayers];
  if (!coded.codestream.empty()) return coded;
  CodestreamOptions options;
  options.mean_squared_error = asked_at(point / kLayers * kLayers);
  options.layers = kLayers;
  options.layer_db = kErrorDb;
  options.sop = true;
  auto codestream = encode_jpeg2000(plane_, precision_, options);
  if (!codestream) throw std::bad_alloc();
  coded.bits = bits_of_layers(*codestream, plane_.samples.size());
  coded.codestream = std::move(*codestream);
  return coded;
}

double KeyCurve::bits_at(int point) const { return coded(point).bits[layer_of(point)]; }

const KeyCurve::Measured& KeyCurve::measured(int point) const {
  if (const auto found = measured_.find(point); found != measured_.end()) return found->second;
  const double asked = asked_at(point);
  auto decoded = decode_jpeg2000(coded(point).codestream, plane_.width, plane_.height,
                                 static_cast<unsigned>(layer_of(point)) + 1);
  if (!decoded) throw std::bad_alloc();
  KeyPoint key{asked, mean_squared_error(plane_, *decoded), bits_at(point), steps_};
  if (key.error > kMostExcess * asked) {
    if (point >= 2) return measured_[point] = measured(point - 2);
    CodedPlane lossless = code_key_plane(plane_, precision_, 0);
    key.error = 0;
    key.bits = 8 * static_cast<double>(lossless.codestream.size()) /
               static_cast<double>(plane_.samples.size());
    decoded = std::move(lossless.decoded);
  }
  return measured_[point] = {key, measure_(*decoded)};
}

double KeyCurve::bits(double asked) const {
  int point = 0;
  while (point + 2 < error_count_ && asked >= asked_at(point + 1)) ++point;
  const double share = std::clamp(std::log2(asked / asked_at(point)) * 2, 0.0, 1.0);
  return bits_at(point) + (bits_at(point + 1) - bits_at(point)) * share;
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
