// The GPU decoder against the golden model, request by request and stage by stage.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include <hmlfc/gpu/decoder.hpp>

#include "oracle/golden_stream.hpp"
#include "oracle/request.hpp"

namespace hmlfc::gpu {

/// The first difference of a check.
struct Mismatch {
  tb::Request request;
  std::string place;   ///< the level block where a stage differs, or empty
  std::string detail;  ///< stage, field, expected and actual
};

/// One line: the request, the place and the difference.
std::string to_string(const Mismatch& mismatch);

/// Counts of what was compared.
struct CheckCounts {
  uint64_t sent = 0;                                 ///< requests
  uint64_t compared = 0;                             ///< answers
  std::array<uint64_t, kErrorCodeCount> statuses{};  ///< answers by status, equal in both
  uint64_t levels = 0;                               ///< blocks of a level compared at all stages

  /// Answers with an error.
  uint64_t failed() const { return compared - statuses[0]; }

  CheckCounts& operator+=(const CheckCounts& other);
};

struct CheckOptions {
  bool stages = true;  ///< also every stage, by the debug variant
  /// Called with the number of requests compared so far.
  std::function<void(uint64_t)> progress = {};
};

struct CheckResult {
  CheckCounts counts;
  std::optional<Mismatch> mismatch;
};

/// Sends the requests of `source` to `decoder` and compares with the model, until the first
/// difference. Samples outside the plane are not compared (STR-6).
Outcome<CheckResult> check_stream(GpuDecoder& decoder, const tb::GoldenStream& stream,
                                  const tb::RequestSource& source, const CheckOptions& options);

}  // namespace hmlfc::gpu
