// The first failure of a run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "oracle/request.hpp"

namespace hmlfc::tb {

/// One finding. A broken protocol rule names no request.
struct Mismatch {
  std::string rule;  ///< the broken rule, such as "answer: sample" or "protocol: burst over 4 KiB"
  std::optional<Request> request;
  std::string place;   ///< the level block, where a stage differs
  std::string detail;  ///< stage, field, expected and actual
  uint64_t cycle = 0;
  uint32_t state_seed = 0;  ///< of the unit (Unit::state_seed)
};

/// One line for a report.
inline std::string to_string(const Mismatch& mismatch) {
  std::string text = mismatch.rule;
  if (mismatch.request) text += ": " + to_string(*mismatch.request);
  if (!mismatch.place.empty()) text += ": at " + mismatch.place;
  if (!mismatch.detail.empty()) text += ": " + mismatch.detail;
  text += " (clock " + std::to_string(mismatch.cycle);
  if (mismatch.state_seed != 0) {
    text += ", HMLFC_RTL_STATE=" + std::to_string(mismatch.state_seed);
  }
  return text + ")";
}

/// Keeps the first finding of a run.
class Findings {
 public:
  void add(Mismatch mismatch) {
    if (first_) return;
    mismatch.state_seed = state_seed_;
    first_ = std::move(mismatch);
  }

  const std::optional<Mismatch>& first() const { return first_; }

  /// Forgets the finding of the run before; the unit's state is drawn by `state_seed`.
  void begin(uint32_t state_seed) {
    first_.reset();
    state_seed_ = state_seed;
  }

 private:
  std::optional<Mismatch> first_;
  uint32_t state_seed_ = 0;
};

}  // namespace hmlfc::tb
