// hmlfc fuzz-dut and minimise: a decoder on random valid streams, and the smallest stream found on
// which it still fails.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <hmlfc/stream_info.hpp>

#include "cli/arguments.hpp"
#include "cli/camera_options.hpp"
#include "cli/dut_options.hpp"
#include "conform/minimise.hpp"
#include "conform/runner.hpp"
#include "io/files.hpp"
#include "io/json_text.hpp"
#include "terminal/progress_bar.hpp"
#include "vectors/field_stream.hpp"
#include "vectors/frame_vector.hpp"
#include "vectors/random_frame.hpp"

namespace hmlfc::cli {

namespace {

struct MinimiseOptions {
  std::filesystem::path file;
  DutOptions dut;
  std::filesystem::path output;
  bool force = false;
  uint32_t trials = 1000;
  vectors::FrameCase frame;  // asked for, if it has a camera or a map
  int stop_level = 0;        // of it

  std::optional<vectors::FrameCase> request() const {
    if (!frame.camera && !frame.map) return std::nullopt;
    vectors::FrameCase request = frame;
    request.stop_level = stop_level;
    return request;
  }
};

std::string shape(std::span<const uint8_t> stream) {
  const auto decoder = Decoder::open(stream);
  if (!decoder) return {};
  const StreamHeader& header = decoder->header();
  return fmt::format("{} bytes, {} x {} views of {} x {} pixels, {} levels", stream.size(),
                     header.rows, header.cols, header.width, header.height, header.tree_height + 1);
}

ExitCode run_minimise(const MinimiseOptions& options) {
  const conform::Dut dut = options.dut.read().front();
  const auto file = value_or_throw(io::map_file(options.file), ExitCode::kInput);
  const OutputFile output(options.output, ".hmlfc", {kStreamSign, options.force, {options.file}});
  auto work = output.path();
  work += ".work";
  const auto run = [&](std::span<const uint8_t> stream) {
    return conform::run_stream(dut, stream, work, options.dut.limits(), options.request());
  };
  const conform::VectorResult first = run(file.bytes());
  if (!first.bad()) {
    throw Failure(ExitCode::kInput,
                  fmt::format("{}: {} does not fail on it: {} {}", options.file.string(), dut.name,
                              status_name(first.status), first.reason));
  }
  const auto still_fails = [&](std::span<const uint8_t> stream) {
    const conform::VectorResult smaller = run(stream);
    return smaller.status == first.status && (!options.request() || smaller.kind == first.kind);
  };
  const auto minimised = value_or_throw(
      conform::minimise(file.bytes(), still_fails, options.trials), ExitCode::kInput);
  value_or_throw(io::write_file(output.path(), minimised.stream), ExitCode::kOutput);
  output.finish();
  const conform::VectorResult last = run(minimised.stream);
  print(fmt::format("from  {}\nto    {}\n      {} reductions kept, {} streams tried\n{}: {}\n",
                    shape(file.bytes()), shape(minimised.stream), minimised.steps, minimised.trials,
                    status_name(last.status), last.reason));
  if (!last.stage.empty()) print(last.stage + "\n");
  return ExitCode::kDone;
}

constexpr unsigned kMinimiseTrials = 300;

struct FuzzOptions {
  DutOptions dut;
  std::filesystem::path folder;
  uint64_t seed = 1;
  uint32_t minutes = 1;
  uint32_t count = 0;
  uint32_t failures = 20;
  bool frames = false;
};

// Limits of random streams that the decoder claims to support.
vectors::Limits stream_limits(const conform::Dut& dut) {
  vectors::Limits limits;
  const Claims& own = dut.claims;
  const ConformanceLimits& level = kConformanceLimits[static_cast<size_t>(own.level)];
  const auto least = [](auto a, auto b, int64_t c) {
    return static_cast<decltype(a)>(std::min(int64_t{std::min(a, b)}, c));
  };
  limits.grid_side = least(limits.grid_side, level.grid_side, std::min(own.rows, own.cols));
  limits.view_side = least(limits.view_side, level.view_side, std::min(own.width, own.height));
  limits.depth = least(limits.depth, level.depth, own.depth);
  limits.window = std::min(limits.window, level.window);
  limits.tree_height = least(limits.tree_height, level.tree_height, own.tree_height);
  limits.extended = own.profile == Profile::kExtended;
  limits.block_sizes = 0;
  for (const unsigned log2 : own.block_log2) limits.block_sizes |= 1u << (log2 - 1);
  return limits;
}

// The recipe that makes the stream a vector (vectors/README.md).
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
  return io::json_text(json, 2) + "\n";
}

void save(const std::filesystem::path& file, std::span<const uint8_t> bytes) {
  value_or_throw(io::write_file(file, bytes), ExitCode::kOutput);
}

void save_text(const std::filesystem::path& file, const std::string& text) {
  save(file, {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

// Runs one decoder on one seed after another.
class Fuzz {
 public:
  Fuzz(const FuzzOptions& options, conform::Dut dut)
      : options_(options), dut_(std::move(dut)), limits_(stream_limits(dut_)) {}

  // Returns whether the decoder decoded the stream of `seed` correctly.
  bool run(uint64_t seed) {
    const auto stream = vectors::random_stream(seed, limits_);
    if (options_.frames) frame_ = vectors::random_frame(seed, *parse_header(stream));
    const conform::VectorResult result = decode(stream);
    if (result.status == conform::Status::kSkipped) {
      throw Failure(ExitCode::kCannotRun, result.reason);
    }
    if (!result.bad()) return true;
    print(fmt::format("seed {}: {}: {}\n", seed, status_name(result.status), result.reason));
    if (!result.stage.empty()) print("  " + result.stage + "\n");
    const auto stem = options_.folder / fmt::format("seed-{}", seed);
    save(stem.string() + ".hmlfc", stream);
    save_text(stem.string() + ".json", recipe(limits_, seed, result));
    if (frame_) save_text(stem.string() + ".frame.json", frame_text(stream));
    save_minimised(stem.string() + ".min.hmlfc", stream, result);
    return false;
  }

 private:
  conform::VectorResult decode(std::span<const uint8_t> stream) const {
    return conform::run_stream(dut_, stream, options_.folder / "work", options_.dut.limits(),
                               frame_);
  }

  // What the renderer was asked for, and what must come of it.
  std::string frame_text(std::span<const uint8_t> stream) const {
    vectors::FrameCase frame = *frame_;
    vectors::expect_frame(*Decoder::open(stream), frame);
    return io::json_text(io::written(frame), 2) + "\n";
  }

  void save_minimised(const std::string& file, const std::vector<uint8_t>& stream,
                      const conform::VectorResult& result) const {
    const auto minimised = value_or_throw(conform::minimise(
                                              stream,
                                              [&](std::span<const uint8_t> smaller) {
                                                const auto found = decode(smaller);
                                                return found.status == result.status &&
                                                       (!frame_ || found.kind == result.kind);
                                              },
                                              kMinimiseTrials),
                                          ExitCode::kInternal);
    save(file, minimised.stream);
    print(fmt::format("  {}: {} of {} bytes\n", file, minimised.stream.size(), stream.size()));
  }

  const FuzzOptions& options_;
  conform::Dut dut_;
  vectors::Limits limits_;
  std::optional<vectors::FrameCase> frame_;  // of the last seed
};

ExitCode run_fuzz(const FuzzOptions& options) {
  using Clock = std::chrono::steady_clock;
  Fuzz fuzz(options, options.dut.read().front());
  const auto lock = take_output_folder(options.folder);
  const auto begin = Clock::now();
  const auto allowed = std::chrono::minutes(options.minutes);
  terminal::ProgressBar progress("Fuzzing", "seconds", terminal::OffTerminal::kLines);
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

void add_minimise(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "minimise", "Reduce a stream on which a decoder fails", run_minimise,
      R"(Removes levels of the tree, views, pixels and tiles as long as the decoder fails in the same way
(fail, error or timeout). Every stream that is tried is valid.

Example:
  hmlfc minimise chess.hmlfc --dut 'sh -c "exit 1" {input} {output}' --trials 20 -o small.hmlfc)");
  add_path(app, "FILE", options.file, "A valid stream on which the decoder fails");
  options.dut.add_to(app, false);
  CLI::Option* inputs =
      add_inputs(app, "A renderer fails at the frame of this camera (CAM-3)",
                 [&options](const hmlfc_dut_camera& camera) { options.frame.camera = camera; });
  add_integer(app, "--stop-level", options.stop_level, 0, 15, "Stop level of that frame");
  add_numbers<2>(app, "--map", "R,C", ',', "row,column", "It fails at the disparity map of a view",
                 [&options](const auto& n) {
                   options.frame.map.emplace().view = {n[0], n[1]};
                 })
      ->excludes(inputs);
  add_integer(app, "--trials", options.trials, 1, 1u << 20, "Maximum number of streams to try");
  add_output(app, options.output, options.force, "FILE", "The smaller stream");
}

void add_fuzz_dut(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "fuzz-dut", "Test a decoder with random valid streams", run_fuzz,
      R"(Compares the decoder with the golden model. For each stream that fails, writes to the folder: the
stream, a smaller one that fails in the same way (*.min.hmlfc, see `hmlfc minimise`), and the recipe
that makes it a vector; of a renderer also what it was asked for (*.frame.json). The streams depend
only on the seed and the declared limits.

Exit status 1: a stream failed.

Example:
  hmlfc fuzz-dut --dut '{hmlfc} decode {input} -o {output}' --seed 7 --count 3 -o findings)");
  options.dut.add_to(app, false);
  app.add_flag("--frames", options.frames, "Test a renderer: a random frame or map of each stream");
  add_integer(app, "--minutes", options.minutes, 1, 1u << 20, "Time to run");
  add_integer(app, "--count", options.count, 0, UINT32_MAX,
              "Number of streams; 0: as many as --minutes allows");
  add_integer(app, "--seed", options.seed, 0, UINT64_MAX,
              "The first seed; each stream has the next");
  add_integer(app, "--failures", options.failures, 1, 1u << 20, "Stop after this many failures");
  add_path(app, "-o,--output", options.folder, "Folder for the failures, created if missing")
      ->type_name("DIR");
}

}  // namespace hmlfc::cli
