#include "conform/summary.hpp"

#include <algorithm>
#include <map>
#include <regex>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "vectors/milestone.hpp"

namespace hmlfc::conform {
namespace {

struct ClauseCount {
  size_t bad = 0;
  size_t run = 0;
  size_t milestone = 0;  // the first of its vectors
};
using ClauseCounts = std::map<std::string, ClauseCount>;

size_t number_of(const VectorResult& result) {
  return vectors::milestone_number(result.milestone).value_or(0);
}

bool counts_as_bad(const VectorResult& result) { return result.bad() && !result.waived(); }

bool simpler(const VectorResult* a, const VectorResult* b) {
  return std::tuple(number_of(*a), a->bytes, a->id) < std::tuple(number_of(*b), b->bytes, b->id);
}

std::vector<MilestoneCount> count_milestones(const Run& run) {
  std::vector<MilestoneCount> counts;
  for (const vectors::MilestoneRow& row : vectors::milestones()) {
    counts.push_back({std::string(row.name), std::string(row.claim)});
  }
  for (const VectorResult& result : run.results) {
    MilestoneCount& count = counts[number_of(result)];
    count.claimed += result.status != Status::kNotSupported;
    count.skipped += result.status == Status::kSkipped;
    count.pass += result.status == Status::kPass;
    count.bad += counts_as_bad(result);
  }
  return counts;
}

ClauseCounts count_clauses(const Run& run) {
  ClauseCounts counts;
  for (const VectorResult& result : run.results) {
    if (result.status != Status::kPass && !result.bad()) continue;
    for (const std::string& clause : result.clauses) {
      ClauseCount& count = counts[clause];
      count.milestone =
          count.run == 0 ? number_of(result) : std::min(count.milestone, number_of(result));
      ++count.run;
      count.bad += counts_as_bad(result);
    }
  }
  return counts;
}

std::vector<std::string> always_failing(const ClauseCounts& counts) {
  std::vector<std::string> clauses;
  for (const auto& [clause, count] : counts) {
    if (count.bad == count.run) clauses.push_back(clause);
  }
  std::ranges::stable_sort(clauses, {},
                           [&](const std::string& clause) { return counts.at(clause).milestone; });
  return clauses;
}

std::string most_suspect(const VectorResult& result, const ClauseCounts& counts) {
  const auto less_suspect = [&](const std::string& a, const std::string& b) {
    const ClauseCount& x = counts.at(a);
    const ClauseCount& y = counts.at(b);
    return std::tuple(x.bad * y.run, x.bad) < std::tuple(y.bad * x.run, y.bad);
  };
  const std::string& clause = *std::ranges::max_element(result.clauses, less_suspect);
  const ClauseCount& count = counts.at(clause);
  if (count.bad == 1) {
    std::vector<std::string_view> planes;
    for (const Plane plane : result.difference->planes) planes.push_back(plane_name(plane));
    return fmt::format("wrong samples, planes {}", fmt::join(planes, ", "));
  }
  return fmt::format("wrong samples, perhaps {}, which fails in {} of {} vectors", clause,
                     count.bad, count.run);
}

std::string cause_of(const VectorResult& result, const ClauseCounts& counts) {
  if (!result.difference) {
    static const std::regex number("\\b[0-9]+\\b");
    if (result.not_counted) return result.reason;
    return std::regex_replace(result.reason, number, "N");
  }
  static const std::regex stage("stage (\\w+) \\(([A-Z]+-[0-9]+)\\)");
  std::smatch found;
  if (std::regex_search(result.stage, found, stage)) {
    return fmt::format("first wrong stage {} ({})", found[1].str(), found[2].str());
  }
  return most_suspect(result, counts);
}

std::vector<Cause> causes_of(const Run& run, const ClauseCounts& counts) {
  std::map<std::string, Cause> by_text;
  for (const VectorResult& result : run.results) {
    if (!counts_as_bad(result)) continue;
    const std::string text = cause_of(result, counts);
    Cause& cause = by_text[text];
    cause.text = text;
    cause.results.push_back(&result);
  }
  std::vector<Cause> causes;
  for (auto& [text, cause] : by_text) {
    std::ranges::sort(cause.results, simpler);
    causes.push_back(std::move(cause));
  }
  std::ranges::sort(causes, [](const Cause& a, const Cause& b) {
    if (a.results.size() != b.results.size()) return a.results.size() > b.results.size();
    return simpler(a.results.front(), b.results.front());
  });
  return causes;
}

}  // namespace

Summary summarise(const Run& run) {
  Summary summary;
  summary.milestones = count_milestones(run);
  const auto first =
      std::ranges::find_if(summary.milestones, [](const auto& count) { return count.bad != 0; });
  if (first == summary.milestones.end()) return summary;
  summary.first = &*first;
  const ClauseCounts counts = count_clauses(run);
  summary.clauses = always_failing(counts);
  summary.causes = causes_of(run, counts);
  for (const VectorResult& result : run.results) {
    if (!counts_as_bad(result)) continue;
    if (summary.look_at == nullptr || simpler(&result, summary.look_at)) summary.look_at = &result;
  }
  return summary;
}

}  // namespace hmlfc::conform
