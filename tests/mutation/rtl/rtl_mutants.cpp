// rtl_mutants: which mutants of the decode unit the conformance vectors find.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "mutated_unit.hpp"
#include "unit_vector.hpp"

namespace hmlfc::tb {
namespace {

constexpr int kExitFailed = 1;
// Without an answer. The unit itself needs some thousand clocks for LOAD and a thousand for a
// block.
constexpr uint64_t kPatience = 20'000;
// Streams that are refused take little time but find nothing in the datapath: as if they were large.
constexpr uint64_t kPixelsOfRefused = 100'000;

struct Options {
  std::filesystem::path suite;
  std::vector<std::string> filters;
  std::vector<unsigned> mutants;
};

// A vector of the suite; its stream is decoded and the unit without a mutant is tried on it when
// that is needed first.
class Candidate {
 public:
  Candidate(std::filesystem::path suite, const vectors::Vector& vector)
      : suite_(std::move(suite)), entry_(vector) {
    if (vector.output) {
      pixels_ = uint64_t{vector.output->rows} * vector.output->cols * vector.output->width *
                vector.output->height;
    }
  }

  // What it has found, by the time that it is likely to take.
  double worth() const {
    return static_cast<double>(1 + kills_) / static_cast<double>(1000 + pixels_);
  }

  // A mutant is only found where the unit without a mutant passes: else throws.
  Verdict try_on(unsigned mutant, uint64_t& clocks) {
    if (!vector_) vector_ = std::make_unique<UnitVector>(suite_, entry_, kMutatedUnit);
    const Verdict verdict = vector_->try_on(make_mutated_unit(mutant), kPatience, clocks);
    if (verdict.pass()) return verdict;
    if (++kills_ == 1) check_unit();
    return verdict;
  }

  const std::string& id() const { return entry_.id; }

 private:
  void check_unit() const {
    uint64_t clocks = 0;
    const Verdict verdict = vector_->try_on(make_mutated_unit(0), kPatience, clocks);
    if (verdict.pass()) return;
    throw std::runtime_error(
        fmt::format("the unit without a mutant fails {}: {}", entry_.id, verdict.difference));
  }

  std::filesystem::path suite_;
  vectors::Vector entry_;
  std::unique_ptr<UnitVector> vector_;
  uint64_t pixels_ = kPixelsOfRefused;
  uint64_t kills_ = 0;
};

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
    if (UnitVector::is_for(kMutatedUnit, file->bytes())) found.emplace_back(options.suite, vector);
  }
  if (found.empty()) throw std::runtime_error("no vector of the suite is for this unit");
  return found;
}

// The vectors that find most in the least time come first.
nlohmann::ordered_json result_of(unsigned mutant, std::vector<Candidate>& suite) {
  std::ranges::stable_sort(suite, std::greater{}, &Candidate::worth);
  uint64_t clocks = 0;
  for (Candidate& candidate : suite) {
    uint64_t taken = 0;
    const Verdict verdict = candidate.try_on(mutant, taken);
    clocks += taken;
    if (verdict.pass()) continue;
    return {{"number", mutant},
            {"result", verdict.hangs ? "hangs" : "killed"},
            {"vector", candidate.id()},
            {"difference", verdict.difference},
            {"clocks", clocks}};
  }
  return {{"number", mutant}, {"result", "survived"}, {"clocks", clocks}};
}

int main_of(int argc, char** argv) {
  CLI::App app{
      "Runs the conformance vectors on mutants of the decode unit; a JSON object a line for each"};
  Options options;
  app.add_option("SUITE", options.suite, "The folder of manifest.json")->required();
  app.add_option("--mutants", options.mutants, "Numbers of mutants, as in mutants.json")
      ->delimiter(',')
      ->required();
  app.add_option("--vectors", options.filters, "Only these vectors")->delimiter(',');
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<Candidate> suite = candidates(options);
    for (const unsigned mutant : options.mutants) {
      fmt::print("{}\n", result_of(mutant, suite).dump());
      std::fflush(stdout);
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
