// hmlfc minimise: the smallest stream found on which a decoder still fails.
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include <hmlfc/stream_info.hpp>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/dut_options.hpp"
#include "cli/output.hpp"
#include "conform/minimise.hpp"
#include "conform/runner.hpp"
#include "io/atomic_file.hpp"
#include "io/mapped_file.hpp"

namespace hmlfc::cli {
namespace {

struct MinimiseOptions {
  std::filesystem::path file;
  DutOptions dut;
  std::filesystem::path output;
  uint32_t trials = 1000;
};

std::string shape(std::span<const uint8_t> stream) {
  const auto header = parse_header(stream);
  if (!header) return {};
  return fmt::format("{} bytes, {} x {} views of {} x {} pixels, {} levels", stream.size(),
                     header->rows, header->cols, header->width, header->height,
                     header->tree_height + 1);
}

ExitCode run_minimise(const MinimiseOptions& options) {
  const conform::Dut dut = options.dut.read().front();
  const auto file = value_or_throw(io::MappedFile::open(options.file), ExitCode::kInput);
  check_output_file(options.output);
  auto work = options.output;
  work += ".work";
  const auto run = [&](std::span<const uint8_t> stream) {
    return conform::run_stream(dut, stream, work, options.dut.limits());
  };
  const conform::VectorResult first = run(file.bytes());
  if (!first.bad()) {
    throw Failure(ExitCode::kInput,
                  fmt::format("{}: {} does not fail on it: {} {}", options.file.string(), dut.name,
                              status_name(first.status), first.reason));
  }
  const auto still_fails = [&](std::span<const uint8_t> stream) {
    return run(stream).status == first.status;
  };
  const auto minimised = value_or_throw(
      conform::minimise(file.bytes(), still_fails, options.trials), ExitCode::kInput);
  value_or_throw(io::write_file(options.output, minimised.stream), ExitCode::kOutput);
  const conform::VectorResult last = run(minimised.stream);
  print(fmt::format("from  {}\nto    {}\n      {} reductions kept, {} streams tried\n{}: {}\n",
                    shape(file.bytes()), shape(minimised.stream), minimised.steps, minimised.trials,
                    status_name(last.status), last.reason));
  if (!last.stage.empty()) print(last.stage + "\n");
  return ExitCode::kDone;
}

}  // namespace

void add_minimise(CLI::App& program, Task& task) {
  const auto options = std::make_shared<MinimiseOptions>();
  CLI::App* app =
      program.add_subcommand("minimise", "Make a stream smaller on which a decoder fails");
  add_path(*app, "FILE", options->file, "A valid stream on which the decoder fails");
  options->dut.add_to(*app, false);
  add_integer(*app, "--trials", options->trials, 1, 1u << 20, "Streams to try at most");
  add_output(*app, options->output, "FILE", "The smaller stream");
  app->footer(
      R"(Leaves out levels of the tree, views, pixels and tiles as long as the decoder fails in the same way
(fail, error or timeout). Every stream that is tried is valid.

Example:
  hmlfc minimise chess.hmlfc --dut 'sh -c "exit 1" {input} {output}' --trials 20 -o small.hmlfc)");
  app->callback([&task, options] { task = [options] { return run_minimise(*options); }; });
}

}  // namespace hmlfc::cli
