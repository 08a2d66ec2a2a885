#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conform/report.hpp"
#include "conform/summary.hpp"
#include "vectors/milestone.hpp"

namespace hmlfc::conform {
namespace {

constexpr size_t kShownClauses = 8;
constexpr size_t kShown = 3;  // failures of each cause; report.html has all

// How many vectors of other milestones were run as bases of the chosen one.
std::string bases_text(const Run& run) {
  if (run.milestone.empty()) return {};
  const auto bases = std::ranges::count_if(run.results, [&](const VectorResult& result) {
    return result.milestone != run.milestone && result.status != Status::kSkipped &&
           result.status != Status::kNotSupported;
  });
  if (bases == 0) return {};
  return fmt::format("; {} were run as bases of refusals", bases);
}

std::string count_text(const Run& run) {
  const Tally counts = tally(run);
  std::string text;
  for (size_t i = 0; i < kStatusCount; ++i) {
    if (counts.count[i] == 0) continue;
    text += fmt::format("{} {}, ", counts.count[i], status_name(static_cast<Status>(i)));
  }
  if (counts.waived != 0) text += fmt::format("{} waived, ", counts.waived);
  return text + fmt::format("of {} vectors", run.results.size()) + bases_text(run);
}

// The words, but for those after the first few.
std::string shortened(std::vector<std::string> words) {
  if (words.size() > kShownClauses) {
    words[kShownClauses] = fmt::format("and {} more", words.size() - kShownClauses);
    words.resize(kShownClauses + 1);
  }
  return fmt::format("{}", fmt::join(words, " "));
}

std::string line_of(const VectorResult& result) {
  std::string line =
      fmt::format("  {:<13} {}: {}\n", status_name(result.status), result.id.text(), result.reason);
  if (!result.stage.empty()) line += fmt::format("                {}\n", result.stage);
  line += fmt::format("                clauses {}\n", shortened(result.clauses));
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
      skipped == 0 ? "" : fmt::format(", {} were not run", skipped), summary.look_at->id.text(),
      summary.look_at->reason, summary.look_at->inspect);
  if (summary.clauses.empty()) return text;
  text += fmt::format("  Its clauses that fail in all vectors: {}\n", shortened(summary.clauses));
  return text;
}

// What follows a milestone that is whole.
std::string where_to_go_on(const Run& run, const Summary& summary) {
  const auto others = tally(run).of(Status::kSkipped);
  std::string text =
      others == 0 ? ""
                  : fmt::format("  Of the other milestones {} vectors were not run.\n", others);
  if (summary.next == nullptr) {
    return text + "  It is the last one: now run all without --milestone.\n";
  }
  const bool renders = &vectors::milestones_with(run.milestone) == &vectors::frame_milestones();
  return text + fmt::format("  Next: --milestone {}, a {} that {}\n", summary.next->name,
                            renders ? "renderer" : "decoder", summary.next->claim);
}

}  // namespace

std::string terminal_text(const Run& run) {
  const Summary summary = summarise(run);
  std::string text = fmt::format("{}: {}: {}\n", run.dut, verdict_text(run), count_text(run));
  if (summary.first != nullptr) text += where_to_begin(summary);
  if (verdict(run) == Verdict::kWhole) text += where_to_go_on(run, summary);
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
