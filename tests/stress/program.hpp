// The common main function of the stress programs.
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "vectors/json.hpp"

namespace hmlfc::stress {

/// Parses the arguments and prints the report that `run` returns, as JSON. Returns the exit status:
/// 0 the report has no "findings", 1 it has some, 2 wrong arguments or an exception of `run`, which
/// is printed to stderr.
int run_program(CLI::App& app, int argc, char** argv, const std::function<vectors::Json()>& run);

}  // namespace hmlfc::stress
