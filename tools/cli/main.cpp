// hmlfc: encodes, decodes, renders and examines light fields.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>

#include <hmlfc/version.hpp>

#include "cli/commands.hpp"
#include "gpu_ref/render/gpu_frame_renderer.hpp"

namespace hmlfc::cli {
namespace {

constexpr const char* kFooter =
    R"(Results go to standard output, messages and progress to standard error. The --help of each command
has an example.

Exit status:
  0   done
  1   a comparison found a difference
  2   wrong arguments, or an output that cannot be created there
  3   an input is missing, unreadable or unsuitable
  4   a stream is corrupt; the message has the specification's name of the error and its address
  5   no failures, but required tests were skipped
  6   encode missed its target; the nearest stream was written
  70  a bug in this program; 71 out of memory; 74 writing failed (full disk, closed pipe)
  77  a decoder under test cannot run on this machine

Example:
  hmlfc synth --scene cards --grid 9x9 --size 512x384 -o views
  hmlfc encode views -o cards.hmlfc
  hmlfc decode cards.hmlfc -o decoded
  hmlfc compare views decoded)";

// The look of --help: "  --window N     largest vector component (default 16)": no list of
// exclusions, no type for flags, the default behind the description.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(34); }

  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string& type = option->get_type_name();
    return option->get_type_size() == 0 || type.empty() ? "" : " " + type;
  }

  std::string make_option_desc(const CLI::Option* option) const override {
    std::string text = option->get_description();
    if (option->get_required() && !option->get_positional()) text += " (required)";
    const std::string standard = option->get_default_str();
    return standard.empty() ? text : text + " (default " + standard + ")";
  }

  std::string make_description(const CLI::App* app) const override {
    return app->get_description() + "\n\n";
  }
};

void add_commands(CLI::App& program, Task& task) {
  program.description(
      "Random-access light field codec: encode, decode, render and examine light fields");
  program.formatter(std::make_shared<HelpFormatter>());
  program.set_help_flag("-h,--help", "Show this help and exit");
  program.set_version_flag("--version", "hmlfc " HMLFC_VERSION, "Show the version and exit");
  program.require_subcommand(1);
  program.get_formatter()->label("SUBCOMMAND", "COMMAND");
  program.footer(kFooter);
  add_synth(program, task);
  add_encode(program, task);
  add_decode(program, task);
  add_info(program, task);
  add_disparity(program, task);
  add_compare(program, task);
  add_inspect(program, task);
  add_bise(program, task);
  add_reference_area(program, task);
  add_render(program, task);
  add_convert(program, task);
  add_viewer(program, task);
  add_picture(program, task);
  add_vectors(program, task);
  add_conform(program, task);
  add_serve(program, task);
  add_minimise(program, task);
  add_fuzz_dut(program, task);
  for (CLI::App* command : program.get_subcommands({})) command->group("Commands");
}

// The chosen command, "hmlfc bise enc", and its parser.
std::pair<std::string, const CLI::App*> chosen_command(const CLI::App& program) {
  std::string name = "hmlfc";
  const CLI::App* app = &program;
  while (!app->get_subcommands().empty()) {
    app = app->get_subcommands().front();
    name += " " + app->get_name();
  }
  return {name, app};
}

// Says in one line what is wrong with the arguments.
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

// The library of JSON takes memory to free a value: where there is none, its destructor cannot
// throw.
[[noreturn]] void end_without_memory() {
  try {
    if (const auto reason = std::current_exception()) std::rethrow_exception(reason);
  } catch (const std::bad_alloc&) {
    constexpr std::string_view kText = "Not enough memory\n";
    static_cast<void>(!::write(STDERR_FILENO, kText.data(), kText.size()));
    std::_Exit(static_cast<int>(ExitCode::kOutOfMemory));
  } catch (...) {
  }
  std::abort();
}

// Runs the program and turns every failure into one message and an exit code.
ExitCode guarded_run(int count, char** arguments) {
  try {
    const ExitCode code = run(count, arguments);
    flush_output();
    return code;
  } catch (const Failure& failure) {
    if (*failure.what() != '\0') note(failure.what());
    return failure.code();
  } catch (const gpu::DeviceError& error) {
    note(std::string("--backend gpu: ") + error.what());
    return ExitCode::kUsage;
  } catch (const std::bad_alloc&) {
    note("Not enough memory");
    return ExitCode::kOutOfMemory;
  } catch (const std::exception& error) {
    const auto* system = dynamic_cast<const std::system_error*>(&error);
    if (system != nullptr && system->code() == std::errc::resource_unavailable_try_again) {
      note("Not enough memory for another thread, or too many of them");
      return ExitCode::kOutOfMemory;
    }
    note(std::string("Internal error: ") + error.what());
    return ExitCode::kInternal;
  }
}

}  // namespace
}  // namespace hmlfc::cli

int main(int count, char** arguments) {
  // A closed pipe and a file over the size limit are errors of write(), not the end of the process.
  std::set_terminate(hmlfc::cli::end_without_memory);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  return static_cast<int>(hmlfc::cli::guarded_run(count, arguments));
}
