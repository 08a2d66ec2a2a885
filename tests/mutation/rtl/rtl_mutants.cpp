// rtl_mutants: which mutants of the decode unit the conformance vectors find.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <MutatedUnit.h>
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "unit/verilated_unit.hpp"
#include "unit_vector.hpp"

namespace hmlfc::tb {
namespace {

constexpr int kExitFailed = 1;
// Without an answer. The unit itself needs some thousand clocks for LOAD and a thousand for a
// block.
constexpr uint64_t kPatience = 20'000;
// Streams that are refused take little time but find nothing in the datapath: as if they were
// large.
constexpr uint64_t kPixelsOfRefused = 100'000;

// The parameters of the unit with mutants in it (plant.py); units.py and CMakeLists.txt have them
// as well.
constexpr UnitParameters kMutatedUnit{2, 12, 8, 4};

// A mutant of mutants.json: its number, from 1 on, and the variant of units.py that it is in.
struct Mutant {
  unsigned number = 0;
  unsigned variant = 0;
};

// The unit with these mutants switched on, at most one in a variant: a plusarg of 16 bits for each
// variant, in hexadecimal, the first variant last.
std::unique_ptr<DecodeUnit> make_mutated_unit(std::span<const Mutant> mutants) {
  std::string digits = "0";
  for (const Mutant& mutant : mutants) {
    const size_t end = 4 * (size_t{mutant.variant} + 1);
    if (digits.size() < end) digits.insert(0, end - digits.size(), '0');
    digits.replace(digits.size() - end, 4, fmt::format("{:04x}", mutant.number));
  }
  return std::make_unique<VerilatedUnit<MutatedUnit>>(kMutatedUnit, "+mutants=" + digits);
}

struct Options {
  std::filesystem::path suite;
  std::vector<std::string> filters;
  std::vector<std::string> mutants;
  uint64_t clocks = UINT64_MAX;  // for a mutant: after these no other vector is begun
};

// A vector of the suite; its stream is decoded and the unit without a mutant is tried on it when
// that is needed first.
class Candidate {
 public:
  Candidate(const Options& options, const vectors::Vector& vector)
      : suite_(options.suite), entry_(vector) {
    if (vector.output) {
      pixels_ = uint64_t{vector.output->rows} * vector.output->cols * vector.output->width *
                vector.output->height;
    }
  }

  // With `mutants` switched on. A mutant is only found where the unit without a mutant passes: else
  // throws.
  Verdict try_on(std::span<const Mutant> mutants, uint64_t& clocks) {
    if (!vector_) vector_ = std::make_unique<UnitVector>(suite_, entry_, kMutatedUnit);
    const Verdict verdict = vector_->try_on(make_mutated_unit(mutants), kPatience, clocks);
    if (verdict.pass()) return verdict;
    if (!checked_) check_unit();
    checked_ = true;
    return verdict;
  }

  const std::string& id() const { return entry_.id; }
  uint64_t pixels() const { return pixels_; }

 private:
  void check_unit() const {
    uint64_t clocks = 0;
    const Verdict verdict = vector_->try_on(make_mutated_unit({}), kPatience, clocks);
    if (verdict.pass()) return;
    throw std::runtime_error(
        fmt::format("the unit without a mutant fails {}: {}", entry_.id, verdict.difference));
  }

  std::filesystem::path suite_;
  vectors::Vector entry_;
  std::unique_ptr<UnitVector> vector_;
  uint64_t pixels_ = kPixelsOfRefused;
  bool checked_ = false;  // that the unit without a mutant passes
};

// Small streams first.
std::vector<Candidate> candidates(const Options& options) {
  const auto manifest = vectors::read_manifest(options.suite);
  if (!manifest) throw std::runtime_error(manifest.error().message);
  std::vector<Candidate> found;
  for (const vectors::Vector& vector : manifest->vectors) {
    const bool chosen = options.filters.empty() ||
                        std::ranges::find(options.filters, vector.id) != options.filters.end();
    if (!chosen) continue;
    const auto file = io::MappedFile::open(options.suite / vector.input.file);
    if (!file) throw std::runtime_error(file.error().message);
    if (UnitVector::is_for(kMutatedUnit, file->bytes())) found.emplace_back(options, vector);
  }
  if (found.empty()) throw std::runtime_error("no vector of the suite is for this unit");
  std::ranges::stable_sort(found, {}, &Candidate::pixels);
  return found;
}

// NUMBER/VARIANT, several of them with + between them; then perhaps :VECTOR.
struct Group {
  std::vector<Mutant> mutants;
  std::string first;  // the vector to be tried first
};

Group parse_group(const std::string& text) {
  Group group;
  const size_t colon = text.find(':');
  if (colon != std::string::npos) group.first = text.substr(colon + 1);
  std::istringstream words(text.substr(0, colon));
  for (std::string word; std::getline(words, word, '+');) {
    const size_t slash = word.find('/');
    if (slash == std::string::npos) throw std::runtime_error(word + " is not NUMBER/VARIANT");
    group.mutants.push_back({static_cast<unsigned>(std::stoul(word.substr(0, slash))),
                             static_cast<unsigned>(std::stoul(word.substr(slash + 1)))});
  }
  return group;
}

void print(const nlohmann::ordered_json& result) {
  fmt::print("{}\n", result.dump());
  std::fflush(stdout);
}

// Tries a group on the vectors, and each of its mutants alone where the group is found: vector
// `first`, then those that found the last mutants: mutants of a module come one after the other,
// and what finds one often finds the next. After `limit` clocks no other is begun. What is left at
// the end, no vector finds: alone, or together with others that none finds.
class Trial {
 public:
  Trial(Group group, std::vector<Candidate>& suite, uint64_t limit)
      : group_(std::move(group)), suite_(suite), limit_(limit) {}

  void run() {
    std::ranges::stable_partition(suite_,
                                  [&](const Candidate& one) { return one.id() == group_.first; });
    for (size_t i = 0; i < suite_.size() && !group_.mutants.empty() && clocks_ < limit_; ++i) {
      const auto at = suite_.begin() + static_cast<std::ptrdiff_t>(i);
      if (try_on(*at)) std::rotate(suite_.begin(), at, at + 1);
    }
    const char* result = clocks_ >= limit_ ? "missed" : "survived";
    for (const Mutant& mutant : group_.mutants) {
      print({{"number", mutant.number}, {"result", result}, {"clocks", clocks_}});
    }
  }

 private:
  Verdict tried(Candidate& candidate, std::span<const Mutant> mutants) {
    uint64_t taken = 0;
    const Verdict verdict = candidate.try_on(mutants, taken);
    clocks_ += taken;
    return verdict;
  }

  // Whether the candidate finds one of the mutants by itself.
  bool try_on(Candidate& candidate) {
    const Verdict verdict = tried(candidate, group_.mutants);
    if (verdict.pass()) return false;
    const size_t before = group_.mutants.size();
    const bool alone = before == 1;
    std::erase_if(group_.mutants, [&](const Mutant& mutant) {
      const Verdict own = alone ? verdict : tried(candidate, std::span(&mutant, 1));
      if (own.pass()) return false;
      print({{"number", mutant.number},
             {"result", own.hangs ? "hangs" : "killed"},
             {"vector", candidate.id()},
             {"difference", own.difference},
             {"clocks", clocks_}});
      return true;
    });
    // The vector finds only several together: what it takes to find them is not known by the group.
    if (group_.mutants.size() < before) return true;
    for (const Mutant& mutant : std::exchange(group_.mutants, {})) {
      Trial({{mutant}, group_.first}, suite_, limit_).run();
    }
    return false;
  }

  Group group_;
  std::vector<Candidate>& suite_;
  uint64_t limit_;
  uint64_t clocks_ = 0;
};

int main_of(int argc, char** argv) {
  CLI::App app{
      "Runs the conformance vectors on mutants of the decode unit; a JSON object a line for each"};
  Options options;
  app.add_option("SUITE", options.suite, "The folder of manifest.json")->required();
  app.add_option("--mutants", options.mutants,
                 "NUMBER/VARIANT as in mutants.json; with + between them several of different "
                 "variants, tried together; with :VECTOR behind it that vector comes first")
      ->delimiter(',')
      ->required();
  app.add_option("--vectors", options.filters, "Only these vectors")->delimiter(',');
  app.add_option("--clocks", options.clocks,
                 "After so many clocks no other vector is tried: \"missed\", not \"survived\"");
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<Candidate> suite = candidates(options);
    for (const std::string& text : options.mutants) {
      Trial(parse_group(text), suite, options.clocks).run();
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
