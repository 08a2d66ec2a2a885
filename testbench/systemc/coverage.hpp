// Functional coverage: what a set of runs has exercised, by the names of one table.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <hmlfc/error.hpp>

#include "oracle/oracle.hpp"
#include "stimulus/conditions.hpp"

namespace hmlfc::tb {

/// The points of the table in coverage.cpp, in its order.
enum class Point : uint8_t {
  kStateZero,
  kStateMotion,
  kStateMotionResidual,
  kStateResidual,
  kKeyBlock,
  kPlaneY,
  kPlaneCo,
  kPlaneCg,
  kPlaneRgb,
  kStopLevelZero,
  kStopLevelBetween,
  kStopLevelTop,
  kBorderRight,
  kBorderBelow,
  kReferenceOutside,
  kSignMinus,
  kOneReference,
  kTwoReferences,
  kPhaseWhole,
  kPhaseX,
  kPhaseY,
  kPhaseBoth,
  kSampleLow,
  kSampleHigh,
  kRequestLast,
  kRequestRepeated,
  kViewChanged,
  kLatencyNone,
  kLatencyLong,
  kReadStall,
  kAddressStall,
  kBackpressure,
  kRequestGap,
  kResetInFlight,
  kDisabled,
  kLoadFailed,
  kStatusBadRequest,
  kStatusBusError,
  kStatusOfBlock,
  kMain,
  kExtended,
  kChroma420,
  kChroma444,
  kOneView,
  kUnevenGrid,
  kDepthAboveEight,
  kCount,
};

inline constexpr size_t kPointCount = static_cast<size_t>(Point::kCount);

/// Counts how often each point was met. Besides those of the table, each error that the unit may
/// name is a point.
class Coverage {
 public:
  void hit(Point point) { ++hits_[static_cast<size_t>(point)]; }
  uint64_t hits(Point point) const { return hits_[static_cast<size_t>(point)]; }

  void on_expected(const ExpectedAnswer& expected, const GoldenStream* stream);
  void on_answer(const ExpectedAnswer& expected, const Answer& answer);
  void on_conditions(const Conditions& conditions);
  void on_stream(const StreamHeader& header);

  /// The unit named `error`, a status of STATUS or of an answer, and rightly.
  void on_error(uint8_t error);

  /// Names of the points that were not met.
  std::vector<std::string> missed() const;

  /// One line a point: its name and how often it was met.
  std::string report() const;

  /// The same as a JSON object.
  std::string to_json() const;

 private:
  void on_level(const LevelRecord& level, const GoldenStream& stream);
  void on_vector(const LevelRecord& level, const SubpelVector& vector, const GoldenStream& stream);

  struct NamedCount {
    std::string name;
    uint64_t hits;
  };
  std::vector<NamedCount> all() const;

  std::array<uint64_t, kPointCount> hits_{};
  std::array<uint64_t, kErrorCodeCount> errors_{};
  Request previous_;
  bool has_previous_ = false;
};

}  // namespace hmlfc::tb
