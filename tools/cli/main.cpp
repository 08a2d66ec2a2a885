// hmlfc: encodes, decodes, renders and examines light fields.
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <hmlfc/version.hpp>

#include "cli/commands.hpp"
#include "gpu_ref/render/gpu_frame_renderer.hpp"
#include "terminal/lost_pages.hpp"

namespace hmlfc::cli {
namespace {

constexpr const char* kFooter =
    R"(Results go to standard output, messages and progress to standard error. The --help of each command
has an example.

Exit status: 0 done; 1 a comparison found a difference; 2 wrong arguments, or an output that cannot be
created there; 3 an input is missing, unreadable or unsuitable; 4 a stream is corrupt; 5 required tests
were skipped; 6 encode missed its target, the nearest stream was written; 70 a bug in this program;
71 out of memory; 74 writing failed; 77 a decoder under test cannot run on this machine

Example:
  hmlfc synth --scene cards --grid 9x9 --size 512x384 -o views
  hmlfc encode views -o cards.hmlfc
  hmlfc view cards.hmlfc)";

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

using AddCommand = void (*)(CLI::App& program, Task& task);

// The commands by what they are for; --help lists the groups in the order of their names' first
// use.
const std::pair<const char*, std::vector<AddCommand>> kGroups[] = {
    {"Start", {add_synth, add_encode, add_viewer}},
    {"Your light field",
     {add_publisher, add_decode, add_render, add_picture, add_compare, add_info, add_disparity,
      add_convert}},
    {"Your decoder", {add_conform, add_inspect, add_minimise, add_fuzz_dut, add_vectors}},
    {"More", {add_bise, add_reference_area, add_serve}}};

void add_commands(CLI::App& program, Task& task) {
  program.description(
      "Random-access light field codec: encode, decode, render and examine light fields");
  program.formatter(std::make_shared<HelpFormatter>());
  program.set_help_flag("-h,--help", "Show this help and exit");
  program.set_version_flag("--version", "hmlfc " HMLFC_VERSION, "Show the version and exit");
  program.require_subcommand(1);
  program.get_formatter()->label("SUBCOMMAND", "COMMAND");
  program.footer(kFooter);
  for (const auto& [group, commands] : kGroups) {
    const size_t before = program.get_subcommands({}).size();
    for (const AddCommand add : commands) add(program, task);
    const auto all = program.get_subcommands({});
    for (size_t k = before; k < all.size(); ++k) all[k]->group(group);
  }
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

// Letters left out, added or changed, and neighbours swapped, from `a` to `b`.
size_t slips(std::string_view a, std::string_view b) {
  std::vector<std::vector<size_t>> d(a.size() + 1, std::vector<size_t>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); ++i) {
    for (size_t j = 0; j <= b.size(); ++j) {
      d[i][j] = i + j;
      if (i == 0 || j == 0) continue;
      d[i][j] = std::min(
          {d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[a.size()][b.size()];
}

// "; did you mean --quality?" with the name that `word` begins or is nearest to; empty where none
// is near.
std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
  const size_t letters =
      word.find_first_not_of('-') == word.npos ? 0 : word.size() - word.find_first_not_of('-');
  if (letters < 2 || letters > 40) return "";
  const auto distance = [&](const std::string& name) {
    return letters > 2 && name.starts_with(word) ? 0 : slips(word, name);
  };
  const auto best = std::ranges::min_element(names, {}, distance);
  if (best == names.end() || distance(*best) > (letters + 1) / 3) return "";
  return "; did you mean " + *best + "?";
}

// Says in one line what is wrong with the arguments.
std::string explain(const CLI::App& app, const CLI::ParseError& error) {
  const auto extra = app.remaining();
  const auto option = std::ranges::find_if(extra, [](auto& word) { return word.starts_with('-'); });
  const auto code = static_cast<CLI::ExitCodes>(error.get_exit_code());
  const bool lacks_or_has_more =
      code == CLI::ExitCodes::RequiredError || code == CLI::ExitCodes::ExtrasError;
  std::vector<std::string> names;
  const bool is_command = !app.get_subcommands([](const CLI::App*) { return true; }).empty();
  const bool is_word = is_command && !extra.empty() && !extra.front().starts_with('-');
  if (option != extra.end() && lacks_or_has_more && !is_word) {
    for (const CLI::Option* known : app.get_options()) {
      for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
    }
    const std::string given = option->substr(0, option->find('='));
    return given + " is not an option" + suggestion(given, names);
  }
  std::string list;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
    list += " " + command->get_name();
  }
  if (names.empty()) return error.what();
  if (extra.empty()) return "a command is needed:" + list;
  const std::string near = suggestion(extra.front(), names);
  return "'" + extra.front() + "' is not one of its commands" + (near.empty() ? ":" + list : near);
}

ExitCode run(int count, char** arguments) {
  Task task;
  CLI::App program;
  program.allow_windows_style_options(false);  // /name is a file, on every system
  add_commands(program, task);
  program.name("hmlfc");
  std::vector<std::string> words(arguments + std::min(count, 1), arguments + count);
  if (!words.empty() && words.front() == "help") {  // hmlfc help encode: hmlfc encode --help
    std::ranges::rotate(words, words.begin() + 1);
    words.back() = "--help";
  }
  std::ranges::reverse(words);  // as CLI11 takes them
  try {
    program.parse(std::move(words));
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
    if (!terminal::pages_were_lost()) return code;
    note("An input became shorter while it was read: do not trust what was written");
    return ExitCode::kInput;
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
  hmlfc::terminal::survive_lost_pages();
  return static_cast<int>(hmlfc::cli::guarded_run(count, arguments));
}
