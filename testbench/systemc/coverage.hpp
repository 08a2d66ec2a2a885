// Functional coverage: counts, by name, what a set of runs has exercised.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <hmlfc/error.hpp>

#include "oracle/oracle.hpp"
#include "stimulus/conditions.hpp"

namespace hmlfc::tb {

// Each point with its name.
#define HMLFC_POINTS(HMLFC_POINT)                                \
  HMLFC_POINT(kStateZero, "state zero")                          \
  HMLFC_POINT(kStateMotion, "state motion only")                 \
  HMLFC_POINT(kStateMotionResidual, "state motion and residual") \
  HMLFC_POINT(kStateResidual, "state residual only")             \
  HMLFC_POINT(kKeyBlock, "block of a key image")                 \
  HMLFC_POINT(kPlaneY, "request plane Y")                        \
  HMLFC_POINT(kPlaneCo, "request plane Co")                      \
  HMLFC_POINT(kPlaneCg, "request plane Cg")                      \
  HMLFC_POINT(kPlaneRgb, "request RGB")                          \
  HMLFC_POINT(kStopLevelZero, "stop level 0")                    \
  HMLFC_POINT(kStopLevelBetween, "stop level between")           \
  HMLFC_POINT(kStopLevelTop, "stop level top")                   \
  HMLFC_POINT(kBorderRight, "block over the right border")       \
  HMLFC_POINT(kBorderBelow, "block over the lower border")       \
  HMLFC_POINT(kReferenceOutside, "reference outside the plane")  \
  HMLFC_POINT(kSignMinus, "sign minus")                          \
  HMLFC_POINT(kOneReference, "one reference")                    \
  HMLFC_POINT(kTwoReferences, "two references")                  \
  HMLFC_POINT(kPhaseWhole, "phase whole sample")                 \
  HMLFC_POINT(kPhaseX, "phase in x alone")                       \
  HMLFC_POINT(kPhaseY, "phase in y alone")                       \
  HMLFC_POINT(kPhaseBoth, "phase in x and y")                    \
  HMLFC_POINT(kSampleLow, "sample at the low end")               \
  HMLFC_POINT(kSampleHigh, "sample at the high end")             \
  HMLFC_POINT(kRequestLast, "request with tlast")                \
  HMLFC_POINT(kRequestRepeated, "same request twice")            \
  HMLFC_POINT(kViewChanged, "view changes")                      \
  HMLFC_POINT(kLatencyNone, "latency 0")                         \
  HMLFC_POINT(kLatencyLong, "latency from 100")                  \
  HMLFC_POINT(kReadStall, "read data stalls")                    \
  HMLFC_POINT(kAddressStall, "read addresses stall")             \
  HMLFC_POINT(kBackpressure, "answers wait")                     \
  HMLFC_POINT(kRequestGap, "requests have gaps")                 \
  HMLFC_POINT(kResetInFlight, "reset with requests in flight")   \
  HMLFC_POINT(kDisabled, "DISABLE, then a second LOAD")          \
  HMLFC_POINT(kLoadFailed, "LOAD fails")                         \
  HMLFC_POINT(kStatusBadRequest, "status bad_request")           \
  HMLFC_POINT(kStatusBusError, "status bus_error")               \
  HMLFC_POINT(kStatusOfBlock, "status of a damaged block")       \
  HMLFC_POINT(kMain, "profile main")                             \
  HMLFC_POINT(kExtended, "profile extended")                     \
  HMLFC_POINT(kChroma420, "chroma 4:2:0")                        \
  HMLFC_POINT(kChroma444, "chroma 4:4:4")                        \
  HMLFC_POINT(kOneView, "one view")                              \
  HMLFC_POINT(kUnevenGrid, "grid that clusters do not divide")   \
  HMLFC_POINT(kDepthAboveEight, "depth above 8")

#define HMLFC_POINT(point, name) point,
enum class Point : uint8_t { HMLFC_POINTS(HMLFC_POINT) kCount };
#undef HMLFC_POINT

inline constexpr size_t kPointCount = static_cast<size_t>(Point::kCount);

/// A point and how often it was met.
struct NamedCount {
  std::string name;
  uint64_t hits;
};

/// Counts how often each point was met: the points above, and each error that the unit may name.
class Coverage {
 public:
  void hit(Point point) { ++hits_[static_cast<size_t>(point)]; }
  uint64_t hits(Point point) const { return hits_[static_cast<size_t>(point)]; }

  void on_expected(const ExpectedAnswer& expected, const GoldenStream* stream);
  void on_answer(const ExpectedAnswer& expected, const Answer& answer);
  void on_conditions(const Conditions& conditions);
  void on_stream(const StreamHeader& header);

  /// Counts an error that the unit reported correctly, in STATUS or in an answer.
  void on_error(uint8_t error);

  /// Names of the points that were not met.
  std::vector<std::string> missed() const;

  /// One line a point: its name and how often it was met.
  std::string report() const;

  /// The same as JSON: {name: times}.
  std::string to_json() const;

 private:
  void on_level(const LevelRecord& level, const GoldenStream& stream);
  void on_vector(const LevelRecord& level, const SubpelVector& vector, const GoldenStream& stream);

  std::vector<NamedCount> all() const;

  std::array<uint64_t, kPointCount> hits_{};
  std::array<uint64_t, kErrorCodeCount> errors_{};
  Request previous_;
  bool has_previous_ = false;
};

}  // namespace hmlfc::tb
