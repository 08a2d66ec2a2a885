// The commands of hmlfc. Each function adds one command to the program's arguments; when it is
// chosen, `task` receives what to run.
#pragma once

#include <functional>

#include "cli/output.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own
class App;
class Option;
}  // namespace CLI

namespace hmlfc::cli {

/// Runs a parsed command; failures are thrown as Failure.
using Task = std::function<ExitCode()>;

void add_synth(CLI::App& program, Task& task);
void add_encode(CLI::App& program, Task& task);
void add_decode(CLI::App& program, Task& task);
void add_info(CLI::App& program, Task& task);
void add_disparity(CLI::App& program, Task& task);
void add_compare(CLI::App& program, Task& task);
void add_inspect(CLI::App& program, Task& task);
void add_bise(CLI::App& program, Task& task);
void add_reference_area(CLI::App& program, Task& task);
void add_render(CLI::App& program, Task& task);
void add_convert(CLI::App& program, Task& task);
void add_picture(CLI::App& program, Task& task);
void add_vectors(CLI::App& program, Task& task);
void add_conform(CLI::App& program, Task& task);
void add_serve(CLI::App& program, Task& task);
void add_minimise(CLI::App& program, Task& task);
void add_fuzz_dut(CLI::App& program, Task& task);
/// `hmlfc view` and `hmlfc publish`; they are in tools/view/.
void add_viewer(CLI::App& program, Task& task);
void add_publisher(CLI::App& program, Task& task);

}  // namespace hmlfc::cli
