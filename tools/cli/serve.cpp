// hmlfc serve: a decoder in a shared library (hmlfc_dut.h) answers the line protocol.
#include <filesystem>

#include "cli/arguments.hpp"
#include "conform/dut_library.hpp"
#include "conform/line_server.hpp"

namespace hmlfc::cli {
namespace {

struct ServeOptions {
  std::filesystem::path library;
};

ExitCode run_serve(const ServeOptions& options) {
  const auto functions =
      value_or_throw(conform::load_dut_library(options.library), ExitCode::kNoDecoder);
  switch (serve_lines(functions)) {
    case conform::ServeEnd::kInput:
      break;
    case conform::ServeEnd::kOutput:
      return ExitCode::kOutput;
    case conform::ServeEnd::kCannotRun:
      return ExitCode::kCannotRun;
    case conform::ServeEnd::kNoFile:
      return ExitCode::kInput;
  }
  return ExitCode::kDone;
}

}  // namespace

void add_serve(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "serve", "Answer requests for blocks by a decoder in a shared library",
      run_serve,
      R"(Reads requests on standard input and answers each on standard output: the line protocol, by which
`hmlfc conform` talks to decoders (docs/line_protocol.md). Each request begins with a number, which its
answer repeats. What the library prints goes to standard error.

Example:
  hmlfc serve libhmlfc_dut_model.so)");
  add_path(app, "LIBRARY", options.library, "A library with the functions of hmlfc_dut.h");
}

}  // namespace hmlfc::cli
