// What the programs of numerical stress have in common.
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "vectors/json.hpp"

namespace hmlfc::stress {

/// Parses the arguments, to which it adds `--plant`, a fault to find; prints the report that `run`
/// returns, as JSON. Returns the exit status: 0 nothing wrong, 1 the report has "findings", 2 wrong
/// arguments or an exception of `run`, which is named on stderr.
int run_program(CLI::App& app, int argc, char** argv, const std::function<vectors::Json()>& run);

}  // namespace hmlfc::stress
