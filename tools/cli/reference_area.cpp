// hmlfc reference-area: the file beside a stream for the decoder in WGSL.
#include <filesystem>

#include <fmt/format.h>

#include <hmlfc/gpu/reference_area.hpp>

#include "cli/arguments.hpp"
#include "cli/view_source.hpp"

namespace hmlfc::cli {
namespace {

struct AreaOptions {
  std::filesystem::path file;
  std::filesystem::path output;
  bool force = false;
};

ExitCode run_area(const AreaOptions& options) {
  const OutputFile output(options.output, "", {"HLRA", options.force, {options.file}});
  const StreamFile file(options.file);
  const auto area = gpu::reference_area(file.decoder());
  if (!area) {
    throw Failure(area.error().kind == gpu::FailureKind::kOutOfMemory ? ExitCode::kOutOfMemory
                                                                      : ExitCode::kInput,
                  file.path().string() + ": " + area.error().message);
  }
  value_or_throw(io::write_file(output.path(), *area), ExitCode::kOutput);
  output.finish();
  print(fmt::format("{}: {} bytes\n", options.output.string(), area->size()));
  return ExitCode::kDone;
}

}  // namespace

void add_reference_area(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "reference-area", "Write what the decoder in WGSL needs beside a stream",
      run_area,
      R"(A browser has no decoder of JPEG 2000: the file holds the decoded key images and the shape of the
stream. hmlfc_gpu.js, installed in share/hmlfc/wgsl, takes both files.

Example:
  hmlfc reference-area chess.hmlfc -o chess.area)");
  add_stream(app, options.file);
  add_output(app, options.output, options.force, "FILE", "The file to write");
}

}  // namespace hmlfc::cli
