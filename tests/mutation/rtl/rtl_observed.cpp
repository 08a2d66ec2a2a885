// rtl_observed: in which checks mutants of a unit show at a pin of their module (observe.py).
#include <sys/mman.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
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
constexpr double kTestSeconds = 1'000;  // the shadows take several times what the unit takes
constexpr size_t kNumbers = size_t{1} << 16U;

// Which mutants have differed, by number. A check may run in a process of its own.
bool* differs() {
  static bool* const shared = static_cast<bool*>(mmap(
      nullptr, kNumbers * sizeof(bool), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  if (shared == MAP_FAILED) throw std::runtime_error("no memory is shared with other processes");
  return shared;
}

// Throws where the unit, which has no mutant, fails the check.
void observe(Check& check) {
  std::fill_n(differs(), kNumbers, false);
  uint64_t clocks = 0;
  const Verdict verdict = check.run(clocks);
  if (!verdict.pass()) {
    throw std::runtime_error(
        fmt::format("the unit without a mutant fails {}: {}", check.id(), verdict.difference));
  }
  std::vector<size_t> numbers;
  for (size_t i = 0; i < kNumbers; ++i) {
    if (differs()[i]) numbers.push_back(i);
  }
  const nlohmann::ordered_json line{
      {"check", check.id()}, {"clocks", clocks}, {"mutants", numbers}};
  fmt::print("{}\n", line.dump());
  std::fflush(stdout);
}

int main_of(int argc, char** argv) {
  CLI::App app{"Runs the checks of a unit; a JSON object a line for each: in which mutants differ"};
  std::filesystem::path suite;
  std::vector<size_t> part{0, 1};
  app.add_option("SUITE", suite, "The folder of manifest.json")->required();
  app.add_option("--part", part, "K N: of the checks only each Nth, from the Kth on")->expected(2);
  CLI11_PARSE(app, argc, argv);
  try {
    test_seconds() = kTestSeconds;
    const auto found = checks(suite);
    for (size_t i = part[0]; i < found.size(); i += part[1]) observe(*found[i]);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "rtl_observed: {}\n", error.what());
    return kExitFailed;
  }
}

}  // namespace
}  // namespace hmlfc::tb

// Called by the unit (observe.py).
extern "C" void hmlfc_differs(int number) { hmlfc::tb::differs()[number] = true; }

int sc_main(int argc, char** argv) { return hmlfc::tb::main_of(argc, argv); }
