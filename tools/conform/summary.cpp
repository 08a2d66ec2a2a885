#include "conform/summary.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
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
  const auto rank = [](const VectorResult& result) {
    return std::tuple(number_of(result), result.not_counted, !result.telling, result.bytes);
  };
  return std::tuple(rank(*a), a->id) < std::tuple(rank(*b), b->id);
}

std::vector<MilestoneCount> count_milestones(const Run& run) {
  std::vector<MilestoneCount> counts;
  const std::string any = run.results.empty() ? std::string() : run.results.front().milestone;
  for (const vectors::MilestoneRow& row : vectors::milestones_with(any)) {
    counts.push_back({{}, std::string(row.name), std::string(row.claim)});
  }
  for (const VectorResult& result : run.results) counts[number_of(result)].add(result);
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

bool is_general(std::string_view clause) {
  constexpr std::string_view kGeneral[] = {"BND", "CNV", "LVL", "STR"};
  return std::ranges::find(kGeneral, clause.substr(0, clause.find('-'))) != std::end(kGeneral);
}

// Of the clauses that begin with milestone number `milestone`, those of most vectors first.
std::vector<std::string> always_failing(const ClauseCounts& counts, size_t milestone) {
  std::vector<std::string> clauses;
  for (const auto& [clause, count] : counts) {
    if (count.bad == count.run && count.milestone == milestone) clauses.push_back(clause);
  }
  if (!std::ranges::all_of(clauses, is_general)) std::erase_if(clauses, is_general);
  std::ranges::stable_sort(clauses, std::greater(),
                           [&](const std::string& clause) { return counts.at(clause).run; });
  return clauses;
}

// `text` with N instead of each number that is a word.
std::string without_numbers(std::string_view text) {
  std::string out;
  for (size_t end = 0; end < text.size();) {
    const size_t begin = std::min(text.find_first_of(kWordCharacters, end), text.size());
    out += text.substr(end, begin - end);
    end = std::min(text.find_first_not_of(kWordCharacters, begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    const bool number = !word.empty() && word.find_first_not_of("0123456789") == word.npos;
    out += number ? "N" : word;
  }
  return out;
}

constexpr size_t kSearchedBytes = 4096;  // of the stages, more than there are

// The name and clause of the first wrong stage, "residual (TIL-10)"; empty if there is none.
std::string_view first_stage(std::string_view stages) {
  constexpr std::string_view kBefore = "stage ";
  stages = stages.substr(0, kSearchedBytes);
  for (size_t at = 0; (at = stages.find(kBefore)) != stages.npos;) {
    stages.remove_prefix(at + kBefore.size());
    const size_t end = stages.find(')');
    const size_t blank = stages.find_first_not_of(kWordCharacters);
    if (end == stages.npos || !stages.substr(blank).starts_with(" (")) continue;
    return stages.substr(0, end + 1);
  }
  return {};
}

// Without what an answer holds and what was asked for besides its first word: of "wrong answer to
// 'record pu=1': no such word" the part "wrong answer to 'record'".
std::string reason_of(std::string_view text) {
  constexpr std::string_view kWrongAnswer = "wrong answer to '";
  if (!text.starts_with(kWrongAnswer)) return without_numbers(text);
  const size_t end = text.find_first_of(" '", kWrongAnswer.size());
  return std::string(text.substr(0, end)) + "'";
}

// What failures have in common.
std::string cause_of(const VectorResult& result) {
  if (result.not_counted) return "not counted: the base does not pass";
  std::string text = !result.kind.empty() ? result.kind
                     : result.difference  ? "wrong samples"
                                          : reason_of(result.reason);
  if (const std::string_view stage = first_stage(result.stage); !stage.empty()) {
    text += fmt::format("; first wrong stage {}", stage);
  } else if (result.difference) {
    const auto& planes = result.difference->planes;
    text += " in " + (planes.empty() ? "milestone " + result.milestone : planes_text(planes));
  }
  return text;
}

std::vector<Cause> causes_of(const Run& run) {
  std::map<std::string, std::vector<const VectorResult*>> by_text;
  for (const VectorResult& result : run.results) {
    if (counts_as_bad(result)) by_text[cause_of(result)].push_back(&result);
  }
  std::vector<Cause> causes;
  for (auto& [text, results] : by_text) {
    std::ranges::sort(results, simpler);
    causes.push_back({text, std::move(results)});
  }
  std::ranges::sort(causes, [](const Cause& a, const Cause& b) {
    const VectorResult* x = a.results.front();
    const VectorResult* y = b.results.front();
    const auto order = std::tuple(x->not_counted, b.results.size());
    const auto other = std::tuple(y->not_counted, a.results.size());
    return order != other ? order < other : simpler(x, y);
  });
  return causes;
}

// The first milestone after the one with this name of which the decoder claims vectors, or null.
const MilestoneCount* next_claimed(const std::vector<MilestoneCount>& milestones,
                                   const std::string& name) {
  auto next = std::ranges::find(milestones, name, &MilestoneCount::name);
  if (next != milestones.end()) ++next;
  next = std::find_if(next, milestones.end(), [](const auto& count) { return count.claimed != 0; });
  return next == milestones.end() ? nullptr : &*next;
}

}  // namespace

void Count::add(const VectorResult& result) {
  ++vectors;
  claimed += result.status != Status::kNotSupported;
  skipped += result.status == Status::kSkipped;
  pass += result.status == Status::kPass;
  bad += counts_as_bad(result);
}

Summary summarise(const Run& run) {
  Summary summary;
  summary.milestones = count_milestones(run);
  if (!run.milestone.empty()) summary.next = next_claimed(summary.milestones, run.milestone);
  const auto first =
      std::ranges::find_if(summary.milestones, [](const auto& count) { return count.bad != 0; });
  if (first == summary.milestones.end()) return summary;
  summary.first = &*first;
  summary.clauses =
      always_failing(count_clauses(run), static_cast<size_t>(first - summary.milestones.begin()));
  summary.causes = causes_of(run);
  for (const VectorResult& result : run.results) {
    if (!counts_as_bad(result)) continue;
    if (summary.look_at == nullptr || simpler(&result, summary.look_at)) summary.look_at = &result;
  }
  return summary;
}

}  // namespace hmlfc::conform
