// rtl_mutants: which mutants of a unit its checks find.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <systemc>

#include "check.hpp"
#include "mutated_unit.hpp"

namespace hmlfc::tb {
namespace {

constexpr int kExitFailed = 1;

// A mutant of mutants.json, by its number, from 1 on.
using Mutant = unsigned;

// These mutants switched on: a bit for each, by its number, in hexadecimal.
std::string plusarg_of(std::span<const Mutant> mutants) {
  constexpr unsigned kBitsOfDigit = 4;
  std::vector<unsigned> digits(1);
  for (const Mutant mutant : mutants) {
    const size_t place = mutant / kBitsOfDigit;
    digits.resize(std::max(digits.size(), place + 1));
    digits[place] |= 1U << mutant % kBitsOfDigit;
  }
  std::ranges::reverse(digits);
  return fmt::format("+mutants={:x}", fmt::join(digits, ""));
}

struct Options {
  std::filesystem::path suite;
  std::vector<std::string> filters;
  std::vector<std::string> mutants;
  uint64_t clocks = UINT64_MAX;  // for a mutant: after these no other check is begun
  bool speed = false;
};

// A check with what it says of the unit without a mutant, once that is needed.
class Candidate {
 public:
  explicit Candidate(std::unique_ptr<Check> check) : check_(std::move(check)) {}

  // With `mutants` switched on. A mutant is only found where the unit without a mutant passes: else
  // throws.
  Verdict try_on(std::span<const Mutant> mutants, uint64_t& clocks) {
    mutants_plusarg() = plusarg_of(mutants);
    Verdict verdict = check_->run(clocks);
    if (!verdict.pass()) unmutated_clocks();
    return verdict;
  }

  uint64_t unmutated_clocks() {
    if (clocks_ != 0) return clocks_;
    mutants_plusarg() = plusarg_of({});
    const Verdict verdict = check_->run(clocks_);
    if (verdict.pass()) return clocks_;
    throw std::runtime_error(
        fmt::format("the unit without a mutant fails {}: {}", id(), verdict.difference));
  }

  const std::string& id() const { return check_->id(); }
  uint64_t size() const { return check_->size(); }

 private:
  std::unique_ptr<Check> check_;
  uint64_t clocks_ = 0;  // of the unit without a mutant, which passes; 0: not tried
};

// Short ones first.
std::vector<Candidate> candidates(const Options& options) {
  std::vector<Candidate> found;
  for (auto& check : checks(options.suite)) {
    const bool chosen = options.filters.empty() ||
                        std::ranges::find(options.filters, check->id()) != options.filters.end();
    if (chosen) found.emplace_back(std::move(check));
  }
  if (found.empty()) throw std::runtime_error("no check is for this unit");
  std::ranges::stable_sort(found, {}, &Candidate::size);
  return found;
}

// A number, or several with + between them; then perhaps :CHECK.
struct Group {
  std::vector<Mutant> mutants;
  std::string first;  // the check to be tried first
};

Group parse_group(const std::string& text) {
  Group group;
  const size_t colon = text.find(':');
  if (colon != std::string::npos) group.first = text.substr(colon + 1);
  std::istringstream words(text.substr(0, colon));
  for (std::string word; std::getline(words, word, '+');) {
    group.mutants.push_back(static_cast<Mutant>(std::stoul(word)));
  }
  return group;
}

void print(const nlohmann::ordered_json& result) {
  fmt::print("{}\n", result.dump());
  std::fflush(stdout);
}

// Tries a group on the checks, and halves of it where the group is found, down to each mutant
// alone: check `first`, then those that found the last mutants: mutants of a module come one after
// the other, and what finds one often finds the next. After `limit` clocks no other is begun. What
// is left at the end, no check finds: alone, or together with others that none finds.
class Trial {
 public:
  Trial(Group group, std::vector<Candidate>& suite, uint64_t limit)
      : group_(std::move(group)), suite_(suite), limit_(limit) {}

  void run() {
    std::ranges::stable_partition(suite_,
                                  [&](const Candidate& one) { return one.id() == group_.first; });
    run_from(0);
  }

 private:
  // From the check at this place on. Checks before it have been tried; others stay behind it.
  void run_from(size_t begin) {
    for (size_t i = begin; i < suite_.size() && !group_.mutants.empty() && clocks_ < limit_; ++i) {
      if (try_on(i) && begin == 0) {
        const auto at = suite_.begin() + static_cast<std::ptrdiff_t>(i);
        std::rotate(suite_.begin(), at, at + 1);
      }
    }
    const char* result = clocks_ >= limit_ ? "missed" : "survived";
    for (const Mutant mutant : group_.mutants) {
      print({{"number", mutant}, {"result", result}, {"clocks", clocks_}});
    }
  }

  Verdict tried(Candidate& candidate, std::span<const Mutant> mutants) {
    uint64_t taken = 0;
    Verdict verdict = candidate.try_on(mutants, taken);
    clocks_ += taken;
    return verdict;
  }

  // Those of `mutants` that the candidate does not find alone; the others are printed. The
  // candidate finds all together.
  std::vector<Mutant> left_of(Candidate& candidate, std::span<const Mutant> mutants,
                              const Verdict& together) {
    if (mutants.size() == 1) {
      print({{"number", mutants.front()},
             {"result", together.hangs ? "hangs" : "killed"},
             {"vector", candidate.id()},
             {"difference", together.difference},
             {"clocks", clocks_}});
      return {};
    }
    std::vector<Mutant> left;
    const size_t half = mutants.size() / 2;
    for (const auto part : {mutants.first(half), mutants.subspan(half)}) {
      const Verdict verdict = tried(candidate, part);
      const std::vector<Mutant> rest = verdict.pass()
                                           ? std::vector<Mutant>(part.begin(), part.end())
                                           : left_of(candidate, part, verdict);
      left.insert(left.end(), rest.begin(), rest.end());
    }
    return left;
  }

  // Whether the check at this place finds one of the mutants by itself.
  bool try_on(size_t place) {
    Candidate& candidate = suite_[place];
    const Verdict verdict = tried(candidate, group_.mutants);
    if (verdict.pass()) return false;
    const size_t before = group_.mutants.size();
    group_.mutants = left_of(candidate, group_.mutants, verdict);
    if (group_.mutants.size() < before) return true;
    // The check finds only several together: what it takes to find them is not known by the group.
    const std::vector<Mutant> all = std::exchange(group_.mutants, {});
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    Trial({{all.begin(), middle}, group_.first}, suite_, limit_).run_from(place);
    Trial({{middle, all.end()}, group_.first}, suite_, limit_).run_from(place);
    return false;
  }

  Group group_;
  std::vector<Candidate>& suite_;
  uint64_t limit_;
  uint64_t clocks_ = 0;
};

// Which of the checks takes other clocks with a mutant, that none has found, until `limit` clocks
// have passed.
void compare_clocks(const Group& group, std::vector<Candidate>& suite, uint64_t limit) {
  uint64_t clocks = 0;
  for (Candidate& candidate : suite) {
    if (clocks >= limit) break;
    const uint64_t unmutated = candidate.unmutated_clocks();
    uint64_t taken = 0;
    static_cast<void>(candidate.try_on(group.mutants, taken));
    clocks += taken;
    if (taken == unmutated) continue;
    print({{"number", group.mutants.front()},
           {"vector", candidate.id()},
           {"clocks", taken},
           {"unmutated", unmutated}});
    return;
  }
}

int main_of(int argc, char** argv) {
  CLI::App app{"Runs the checks of a unit on its mutants; a JSON object a line for each"};
  Options options;
  app.add_option("SUITE", options.suite, "The folder of manifest.json")->required();
  app.add_option(
         "--mutants", options.mutants,
         "Numbers of mutants.json; with + between them they are tried together; with :CHECK "
         "behind it that check comes first")
      ->delimiter(',')
      ->required();
  app.add_option("--vectors", options.filters, "Only these checks")->delimiter(',');
  app.add_option("--clocks", options.clocks,
                 "After so many clocks no other check is tried: \"missed\", not \"survived\"");
  app.add_flag(
      "--speed", options.speed,
      "Print only the first check that takes other clocks than without the mutant, if any");
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<Candidate> suite = candidates(options);
    for (const std::string& text : options.mutants) {
      const Group group = parse_group(text);
      if (options.speed) {
        compare_clocks(group, suite, options.clocks);
      } else {
        Trial(group, suite, options.clocks).run();
      }
    }
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "rtl_mutants: {}\n", error.what());
    return kExitFailed;
  }
}

}  // namespace
}  // namespace hmlfc::tb

int sc_main(int argc, char** argv) { return hmlfc::tb::main_of(argc, argv); }
