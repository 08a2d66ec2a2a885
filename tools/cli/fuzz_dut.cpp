// hmlfc fuzz-dut: a decoder on random valid streams, beyond the suite.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include <hmlfc/stream_info.hpp>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/dut_options.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "conform/minimise.hpp"
#include "conform/runner.hpp"
#include "io/atomic_file.hpp"
#include "vectors/random_stream.hpp"

namespace hmlfc::cli {
namespace {

constexpr unsigned kMinimiseTrials = 300;

struct FuzzOptions {
  DutOptions dut;
  std::filesystem::path folder;
  uint64_t seed = 1;
  uint32_t minutes = 1;
  uint32_t count = 0;
  uint32_t failures = 20;
};

// Random streams that the decoder claims to decode.
vectors::Limits stream_limits(const conform::Dut& dut) {
  vectors::Limits limits;
  const conform::DutLimits& own = dut.limits;
  const ConformanceLimits& level = kConformanceLimits[static_cast<size_t>(dut.level)];
  limits.grid_side = std::min({limits.grid_side, level.grid_side, own.rows, own.cols});
  limits.view_side = std::min({limits.view_side, level.view_side, own.width, own.height});
  limits.depth = std::min({limits.depth, level.depth, own.depth});
  limits.window = std::min(limits.window, level.window);
  limits.tree_height = std::min({limits.tree_height, level.tree_height, own.tree_height});
  limits.extended = dut.profile == Profile::kExtended;
  limits.block_sizes = 0;
  for (const unsigned log2 : own.block_log2) limits.block_sizes |= 1u << (log2 - 1);
  return limits;
}

// The recipe of a stream (vectors/README.md), with which it becomes a vector.
std::string recipe(const vectors::Limits& limits, uint64_t seed,
                   const conform::VectorResult& result) {
  Json json;
  json["group"] = "fuzz";
  json["vectors"] = {{{"name", fmt::format("seed-{}", seed)},
                      {"comment", "found by hmlfc fuzz-dut: " + result.reason},
                      {"seed", seed},
                      {"stream",
                       {{"kind", "random"},
                        {"limits",
                         {{"grid_side", limits.grid_side},
                          {"view_side", limits.view_side},
                          {"depth", limits.depth},
                          {"window", limits.window},
                          {"tree_height", limits.tree_height},
                          {"main", limits.main},
                          {"extended", limits.extended},
                          {"block_sizes", limits.block_sizes}}}}}}};
  return json.dump(2) + "\n";
}

void save(const std::filesystem::path& file, std::span<const uint8_t> bytes) {
  value_or_throw(io::write_file(file, bytes), ExitCode::kOutput);
}

// One decoder, seed after seed.
class Fuzz {
 public:
  Fuzz(const FuzzOptions& options, conform::Dut dut)
      : options_(options), dut_(std::move(dut)), limits_(stream_limits(dut_)) {}

  // Returns whether the stream of `seed` was decoded rightly.
  bool run(uint64_t seed) {
    const auto stream = vectors::random_stream(seed, limits_);
    const conform::VectorResult result = decode(stream);
    if (result.status == conform::Status::kSkipped) {
      throw Failure(ExitCode::kCannotRun, result.reason);
    }
    if (!result.bad()) return true;
    print(fmt::format("seed {}: {}: {}\n", seed, status_name(result.status), result.reason));
    if (!result.stage.empty()) print("  " + result.stage + "\n");
    const auto stem = options_.folder / fmt::format("seed-{}", seed);
    save(stem.string() + ".hmlfc", stream);
    const std::string text = recipe(limits_, seed, result);
    save(stem.string() + ".json", {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
    save_minimised(stem.string() + ".min.hmlfc", stream, result);
    return false;
  }

 private:
  conform::VectorResult decode(std::span<const uint8_t> stream) const {
    return conform::run_stream(dut_, stream, options_.folder / "work", options_.dut.limits());
  }

  void save_minimised(const std::string& file, const std::vector<uint8_t>& stream,
                      const conform::VectorResult& result) const {
    const auto minimised = value_or_throw(conform::minimise(
                                              stream,
                                              [&](std::span<const uint8_t> smaller) {
                                                return decode(smaller).status == result.status;
                                              },
                                              kMinimiseTrials),
                                          ExitCode::kInternal);
    save(file, minimised.stream);
    print(fmt::format("  {}: {} of {} bytes\n", file, minimised.stream.size(), stream.size()));
  }

  const FuzzOptions& options_;
  conform::Dut dut_;
  vectors::Limits limits_;
};

ExitCode run_fuzz(const FuzzOptions& options) {
  using Clock = std::chrono::steady_clock;
  Fuzz fuzz(options, options.dut.read().front());
  make_output_folder(options.folder);
  const auto begin = Clock::now();
  const auto allowed = std::chrono::minutes(options.minutes);
  ProgressBar progress("Fuzzing", "seconds");
  uint64_t streams = 0;
  uint64_t failures = 0;
  for (uint64_t seed = options.seed; failures < options.failures; ++seed) {
    const auto spent = Clock::now() - begin;
    if (options.count != 0 ? streams == options.count : spent >= allowed) break;
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(spent).count();
    progress.update(std::min<uint64_t>(static_cast<uint64_t>(seconds), 60 * options.minutes),
                    60 * uint64_t{options.minutes});
    ++streams;
    if (!fuzz.run(seed)) ++failures;
  }
  progress.clear();
  print(fmt::format("seeds {} to {}: {} streams, {} failures\n", options.seed,
                    options.seed + streams - 1, streams, failures));
  return failures == 0 ? ExitCode::kDone : ExitCode::kDifferent;
}

}  // namespace

void add_fuzz_dut(CLI::App& program, Task& task) {
  const auto options = std::make_shared<FuzzOptions>();
  CLI::App* app = program.add_subcommand("fuzz-dut", "Test a decoder with random valid streams");
  options->dut.add_to(*app, false);
  add_integer(*app, "--minutes", options->minutes, 1, 1u << 20, "How long");
  add_integer(*app, "--count", options->count, 0, UINT32_MAX,
              "So many streams, however long they take; 0: by --minutes");
  add_integer(*app, "--seed", options->seed, 0, UINT64_MAX, "The first seed; they go on from it");
  add_integer(*app, "--failures", options->failures, 1, 1u << 20, "Stop after so many failures");
  add_output(*app, options->folder, "DIR", "Folder for what fails, made if it is missing");
  app->footer(
      R"(Each stream is compared with the golden model. Of one that fails the folder gets the stream, a smaller
one that fails in the same way (*.min.hmlfc, see `hmlfc minimise`), and the recipe that makes it a
vector. The streams depend on seed and declared limits alone.

Exit status 1: a stream failed.

Example:
  hmlfc fuzz-dut --dut '{hmlfc} decode {input} -o {output}' --seed 7 --count 3 -o findings)");
  app->callback([&task, options] { task = [options] { return run_fuzz(*options); }; });
}

}  // namespace hmlfc::cli
