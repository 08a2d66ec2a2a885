#include "conform/result.hpp"

#include <array>

namespace hmlfc::conform {
namespace {

constexpr std::array<std::string_view, kStatusCount> kStatusNames{
    "pass", "fail", "error", "timeout", "not_supported", "skipped"};

}  // namespace

std::string_view status_name(Status status) { return kStatusNames[static_cast<size_t>(status)]; }

std::optional<Status> status_from_name(std::string_view name) {
  for (size_t i = 0; i < kStatusCount; ++i) {
    if (kStatusNames[i] == name) return static_cast<Status>(i);
  }
  return std::nullopt;
}

Tally tally(const Run& run) {
  Tally tally;
  for (const VectorResult& result : run.results) {
    if (result.waived()) {
      ++tally.waived;
    } else {
      ++tally.count[static_cast<size_t>(result.status)];
    }
  }
  return tally;
}

Verdict verdict(const Run& run) {
  const Tally counts = tally(run);
  if (counts.bad() != 0) return Verdict::kFails;
  const bool complete = counts.of(Status::kSkipped) == 0 && counts.of(Status::kPass) != 0;
  return complete ? Verdict::kConforms : Verdict::kIncomplete;
}

std::string verdict_text(const Run& run) {
  switch (verdict(run)) {
    case Verdict::kConforms:
      return tally(run).waived == 0 ? "conforms" : "conforms, with waivers";
    case Verdict::kIncomplete:
      return "incomplete";
    case Verdict::kFails:
      return "fails";
  }
  return {};
}

}  // namespace hmlfc::conform
