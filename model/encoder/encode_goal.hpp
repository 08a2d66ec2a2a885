// States what an encoding is to reach, on one scale for all targets.
#pragma once

#include <cmath>
#include <cstdint>
#include <variant>

#include <hmlfc/encoder.hpp>

namespace hmlfc {

/// Approximate gain of a step of quality in dB: 0.1 to 0.23 dB on light fields that were tried.
constexpr double kDbPerQuality = 0.16;

/// A target and how far an encoding is from it, in dB: a doubling of the bytes counts as
/// what the PSNR gains over as many steps of quality.
class EncodeGoal {
 public:
  explicit EncodeGoal(const EncodeTarget& target) : target_(target) {}

  /// Returns by how much the encoding exceeds the target: above 0 it has more quality or more
  /// bytes.
  double surplus_db(double psnr_db, double bytes) const {
    if (const auto* psnr = std::get_if<TargetPsnr>(&target_)) return psnr_db - psnr->db;
    const auto most = static_cast<double>(std::get<TargetBytes>(target_).bytes);
    return kDbPerDoubling * std::log2(bytes / most);
  }

  /// Whether the target is a least, which any surplus meets, or a most, which none does.
  bool is_least() const { return std::holds_alternative<TargetPsnr>(target_); }
  bool is_met(double surplus_db) const { return is_least() ? surplus_db >= 0 : surplus_db <= 0; }

  /// An encoding that meets the target and is no farther from it is near enough: 0.02 dB, or two
  /// percent of the bytes, about what a step of quality is worth.
  double tolerance_db() const { return is_least() ? 0.02 : kDbPerDoubling * 0.0286; }

  /// The least PSNR, if that is the target.
  const TargetPsnr* psnr() const { return std::get_if<TargetPsnr>(&target_); }

 private:
  static constexpr double kDbPerDoubling = 1.3;

  EncodeTarget target_;
};

}  // namespace hmlfc
