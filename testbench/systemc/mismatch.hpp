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
};

/// One line for a report.
inline std::string to_string(const Mismatch& mismatch) {
  std::string text = mismatch.rule;
  if (mismatch.request) text += ": " + to_string(*mismatch.request);
  if (!mismatch.place.empty()) text += ": at " + mismatch.place;
  if (!mismatch.detail.empty()) text += ": " + mismatch.detail;
  return text + " (clock " + std::to_string(mismatch.cycle) + ")";
}

/// Keeps the first finding of a run.
class Findings {
 public:
  void add(Mismatch mismatch) {
    if (!first_) first_ = std::move(mismatch);
  }

  const std::optional<Mismatch>& first() const { return first_; }
  void clear() { *this = {}; }

 private:
  std::optional<Mismatch> first_;
};

}  // namespace hmlfc::tb
