// States what an encoding is to reach, on one scale for all targets.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>

#include <hmlfc/encoder.hpp>

namespace hmlfc {

/// Approximate gain of a step of quality in dB: 0.1 to 0.23 dB on light fields that were tried.
constexpr double kDbPerQuality = 0.16;

/// A quality and by how many dB it exceeds a target.
struct QualitySurplus {
  double quality = 0;
  double db = 0;
};

/// What a step of quality gains between `a` and `b`, as far as that is credible.
inline double db_per_quality(const QualitySurplus& a, const QualitySurplus& b) {
  return a.quality == b.quality ? kDbPerQuality
                                : std::clamp((b.db - a.db) / (b.quality - a.quality), 0.04, 0.3);
}

/// The quality of samples of `depth` bits, in eighths, that meets the target if a step gains
/// `db_per_quality`.
inline double next_quality(const QualitySurplus& now, double db_per_quality, int depth) {
  const double next = now.quality - now.db / db_per_quality;
  return std::round(std::clamp(next, lowest_quality(depth), kHighestQuality) * 8) / 8;
}

/// The mean squared error of samples of `depth` bits with a PSNR of `db`.
inline double error_of_psnr(double db, int depth) {
  const double peak = static_cast<double>((1 << depth) - 1);
  return peak * peak * std::pow(10.0, -db / 10);
}

/// A target and how far an encoding is from it, in dB: a doubling of the bytes counts as
/// what the PSNR gains over as many steps of quality.
class EncodeGoal {
 public:
  explicit EncodeGoal(const EncodeTarget& target) : target_(target) {}

  /// Returns by how much an encoding exceeds the target: above 0 it has more quality or more bytes.
  double surplus_db(double psnr_db, double bytes) const {
    if (const auto* psnr = std::get_if<TargetPsnr>(&target_)) return psnr_db - psnr->db;
    const auto most = static_cast<double>(std::get<TargetBytes>(target_).bytes);
    return kDbPerDoubling * std::log2(bytes / most);
  }
  double surplus_db(const EncodedStream& stream, const LightFieldShape& shape) const {
    const uint64_t samples = uint64_t{shape.rows} * shape.cols * shape.width * shape.height * 3;
    return surplus_db(hmlfc::psnr(stream.error.rgb_squares, samples, shape.depth),
                      static_cast<double>(stream.bytes.size()));
  }

  /// Whether the target is a least, which any surplus meets, or a most, which none does.
  bool is_least() const { return std::holds_alternative<TargetPsnr>(target_); }
  bool is_met(double surplus_db) const { return is_least() ? surplus_db >= 0 : surplus_db <= 0; }

  /// Whether an encoding meets the target and is no farther from it than `times` the tolerance.
  bool is_near(double surplus_db, int times = 1) const {
    return is_met(surplus_db) && std::abs(surplus_db) < times * tolerance_db();
  }

  /// An encoding that meets the target and is no farther from it is near enough: 0.03 dB, or two
  /// percent of the bytes.
  double tolerance_db() const { return is_least() ? 0.03 : kDbPerDoubling * 0.0286; }

  /// What so many steps of quality more multiply bytes with.
  static double bytes_for(double steps) {
    return std::exp2(steps * kDbPerQuality / kDbPerDoubling);
  }

  /// The least PSNR, if that is the target.
  const TargetPsnr* psnr() const { return std::get_if<TargetPsnr>(&target_); }

 private:
  static constexpr double kDbPerDoubling = 1.3;

  EncodeTarget target_;
};

}  // namespace hmlfc
