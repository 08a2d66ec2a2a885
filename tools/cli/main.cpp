// hmlfc: encode, decode and examine light fields.
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include <hmlfc/version.hpp>

#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/help_formatter.hpp"
#include "cli/output.hpp"
#include "gpu_ref/frame_renderer.hpp"

namespace hmlfc::cli {
namespace {

constexpr const char* kFooter =
    R"(Results go to standard output, messages and progress to standard error. Each command has a --help
with an example.

Exit status:
  0   done
  1   a comparison found a difference
  2   wrong arguments, or an output that cannot be made at the named place
  3   an input is missing, unreadable or not acceptable
  4   a stream is corrupt; the message has the specification's name of the error and its place
  5   a decoder failed nothing, but not all that is required of it was tested
  70  a defect of this program; 71 not enough memory; 74 writing failed (full disk, closed pipe)
  77  a decoder under test cannot run on this machine

Example:
  hmlfc synth --scene cards --grid 9x9 --size 512x384 -o views
  hmlfc encode views -o cards.hmlfc
  hmlfc decode cards.hmlfc -o decoded
  hmlfc compare views decoded)";

void add_commands(CLI::App& program, Task& task) {
  program.description("Random-access light field codec: encode, decode and examine light fields");
  program.formatter(std::make_shared<HelpFormatter>());
  program.set_help_flag("-h,--help", "Show this help");
  program.set_version_flag("--version", "hmlfc " HMLFC_VERSION, "Show the version");
  program.require_subcommand(1);
  program.get_formatter()->label("SUBCOMMAND", "COMMAND");
  program.footer(kFooter);
  add_synth(program, task);
  add_encode(program, task);
  add_decode(program, task);
  add_info(program, task);
  add_compare(program, task);
  add_inspect(program, task);
  add_bise(program, task);
  add_render(program, task);
  add_picture(program, task);
  add_vectors(program, task);
  add_conform(program, task);
  add_decode_with(program, task);
  add_minimise(program, task);
  add_fuzz_dut(program, task);
  for (CLI::App* command : program.get_subcommands({})) command->group("Commands");
}

// "hmlfc bise enc": the command that the arguments chose so far, and its parser.
std::pair<std::string, const CLI::App*> chosen_command(const CLI::App& program) {
  std::string name = "hmlfc";
  const CLI::App* app = &program;
  while (!app->get_subcommands().empty()) {
    app = app->get_subcommands().front();
    name += " " + app->get_name();
  }
  return {name, app};
}

// What is wrong with the arguments, in one line.
std::string explain(const CLI::App& app, const CLI::ParseError& error) {
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  if (commands.empty()) return error.what();
  std::string names;
  for (const CLI::App* command : commands) names += " " + command->get_name();
  const auto extra = app.remaining();
  if (extra.empty()) return "a command is needed:" + names;
  return "'" + extra.front() + "' is not one of its commands:" + names;
}

ExitCode run(int count, char** arguments) {
  Task task;
  CLI::App program;
  add_commands(program, task);
  program.name("hmlfc");
  try {
    program.parse(count, arguments);
  } catch (const CLI::CallForHelp&) {
    print(program.help());
    return ExitCode::kDone;
  } catch (const CLI::CallForVersion& version) {
    print(std::string(version.what()) + "\n");
    return ExitCode::kDone;
  } catch (const CLI::ParseError& error) {
    const auto [name, app] = chosen_command(program);
    throw Failure(ExitCode::kUsage,
                  name + ": " + explain(*app, error) + "\nRun " + name + " --help for help");
  }
  return task();
}

// Runs the program; every failure becomes one message and an exit code.
ExitCode guarded_run(int count, char** arguments) {
  try {
    const ExitCode code = run(count, arguments);
    flush_output();
    return code;
  } catch (const Failure& failure) {
    note(failure.what());
    return failure.code();
  } catch (const gpu::DeviceError& error) {
    note(std::string("--backend gpu: ") + error.what());
    return ExitCode::kUsage;
  } catch (const std::bad_alloc&) {
    note("Not enough memory");
    return ExitCode::kOutOfMemory;
  } catch (const std::exception& error) {
    note(std::string("Internal error: ") + error.what());
    return ExitCode::kInternal;
  }
}

}  // namespace
}  // namespace hmlfc::cli

int main(int count, char** arguments) {
  // A closed pipe and a file over the size limit are errors of write(), not the end of the process.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  return static_cast<int>(hmlfc::cli::guarded_run(count, arguments));
}
