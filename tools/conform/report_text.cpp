#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conform/report.hpp"
#include "conform/summary.hpp"

namespace hmlfc::conform {
namespace {

constexpr size_t kShown = 3;  // failures of each cause; report.html has all

std::string verdict_line(const Run& run) {
  const Tally counts = tally(run);
  std::string line = fmt::format("{}: {}:", run.dut, verdict_text(run));
  for (size_t i = 0; i < kStatusCount; ++i) {
    if (counts.count[i] == 0) continue;
    line += fmt::format(" {} {},", counts.count[i], status_name(static_cast<Status>(i)));
  }
  if (counts.waived != 0) line += fmt::format(" {} waived,", counts.waived);
  return line + fmt::format(" of {} vectors\n", run.results.size());
}

std::string line_of(const VectorResult& result) {
  std::string line =
      fmt::format("  {:<13} {}: {}\n", status_name(result.status), result.id, result.reason);
  if (!result.stage.empty()) line += fmt::format("                {}\n", result.stage);
  line += fmt::format("                clauses {}\n", fmt::join(result.clauses, " "));
  if (result.waived()) line += fmt::format("                waived: {}\n", result.waiver);
  return line;
}

std::string where_to_begin(const Summary& summary) {
  const size_t skipped = summary.first->skipped;
  std::string text = fmt::format(
      "  Begin with milestone {}, the first that is not whole: {} of {} vectors pass{}\n"
      "  Look first at {}: {}\n"
      "    {}\n",
      summary.first->name, summary.first->pass, summary.first->claimed,
      skipped == 0 ? "" : fmt::format(", {} were not run", skipped), summary.look_at->id,
      summary.look_at->reason, summary.look_at->inspect);
  if (!summary.clauses.empty()) {
    text += fmt::format("  Clauses that fail in all their vectors: {}\n",
                        fmt::join(summary.clauses, " "));
  }
  return text;
}

}  // namespace

std::string terminal_text(const Run& run) {
  const Summary summary = summarise(run);
  std::string text = verdict_line(run);
  if (summary.first != nullptr) text += where_to_begin(summary);
  for (const Cause& cause : summary.causes) {
    text += fmt::format("\n  {} x {}\n", cause.results.size(), cause.text);
    for (size_t i = 0; i < std::min(kShown, cause.results.size()); ++i) {
      text += line_of(*cause.results[i]);
    }
    if (cause.results.size() > kShown) {
      text += fmt::format("  and {} more\n", cause.results.size() - kShown);
    }
  }
  for (const VectorResult& result : run.results) {
    if (result.waived()) text += line_of(result);
  }
  return text;
}

}  // namespace hmlfc::conform
