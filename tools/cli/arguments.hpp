// Commands, and options and positionals that are read strictly.
#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <hmlfc/decoder.hpp>

#include "cli/commands.hpp"
#include "cli/output_files.hpp"
#include "io/name_numbers.hpp"
#include "io/view_list.hpp"
#include "terminal/numbers.hpp"

namespace hmlfc::cli {

using terminal::parse_decimals;
using terminal::parse_integer;
using terminal::parse_numbers;

/// A command and what its options set; `app` owns the options.
template <class Options>
struct Command {
  CLI::App& app;
  Options& options;
};

/// Adds command `name` to `parent`. When it is chosen, `task` becomes run(options).
template <class Options>
Command<Options> add_command(CLI::App& parent, Task& task, const std::string& name,
                             const std::string& description, ExitCode (*run)(const Options&),
                             const std::string& footer) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = parent.add_subcommand(name, description);
  app->footer(footer);
  app->callback([&task, options, run] { task = [options, run] { return run(*options); }; });
  return {*app, *options};
}

/// Stores what `text` says; false where it is not what was expected.
using Reader = std::function<bool(const std::string& text)>;

/// Adds an option ("--name,-n") or positional ("NAME") with one value, read by `reader`.
/// `type_name` appears in the help, `expected` in the message about another value.
CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& type_name,
                       const std::string& description, const std::string& expected, Reader reader);

/// Stores an integer in [lo, hi] in `target`, a T or an optional T.
template <std::integral T, class Target>
CLI::Option* add_integer_to(CLI::App& app, const std::string& name, Target& target, T lo, T hi,
                            const std::string& description) {
  const auto reader = [&target, lo, hi](const std::string& text) {
    const auto value = parse_integer<T>(text);
    const bool good = value && *value >= lo && *value <= hi;
    if (good) target = *value;
    return good;
  };
  return add_value(app, name, "N", description, fmt::format("an integer in [{}, {}]", lo, hi),
                   reader);
}

/// An integer in [lo, hi]; the help shows the value that `target` has now as the default.
template <std::integral T>
CLI::Option* add_integer(CLI::App& app, const std::string& name, T& target,
                         std::type_identity_t<T> lo, std::type_identity_t<T> hi,
                         const std::string& description) {
  return add_integer_to<T>(app, name, target, lo, hi, description)
      ->default_str(std::to_string(target));
}

/// The same without a default.
template <std::integral T>
CLI::Option* add_integer(CLI::App& app, const std::string& name, std::optional<T>& target,
                         std::type_identity_t<T> lo, std::type_identity_t<T> hi,
                         const std::string& description) {
  return add_integer_to<T>(app, name, target, lo, hi, description);
}

/// A decimal number in [lo, hi], given to `store`; `expected` describes it.
CLI::Option* add_decimal(CLI::App& app, const std::string& name, const std::string& type_name,
                         double lo, double hi, const std::string& description,
                         const std::string& expected, std::function<void(double)> store);

/// The same for a target.
CLI::Option* add_decimal(CLI::App& app, const std::string& name, const std::string& type_name,
                         std::optional<double>& target, double lo, double hi,
                         const std::string& description);

/// One of a few words.
template <class T>
CLI::Option* add_choice(CLI::App& app, const std::string& name, T& target,
                        std::vector<std::pair<std::string, T>> choices,
                        const std::string& description) {
  std::string words;
  for (const auto& [word, value] : choices) words += (words.empty() ? "" : "|") + word;
  const auto reader = [&target, choices = std::move(choices)](const std::string& text) {
    const auto found = std::ranges::find(choices, text, &std::pair<std::string, T>::first);
    if (found != choices.end()) target = found->second;
    return found != choices.end();
  };
  return add_value(app, name, words, description, words, reader);
}

/// N integers separated by `separator`, such as "3,5"; `expected` describes them. `store` returns
/// whether they are good, or nothing where all are.
template <size_t N, class Store>
CLI::Option* add_numbers(CLI::App& app, const std::string& name, const std::string& type_name,
                         char separator, const std::string& expected,
                         const std::string& description, Store store) {
  const auto reader = [separator, store](const std::string& text) {
    const auto numbers = parse_numbers<N>(text, separator);
    if (!numbers) return false;
    if constexpr (!std::is_void_v<decltype(store(*numbers))>) return store(*numbers);
    store(*numbers);
    return true;
  };
  return add_value(app, name, type_name, description, expected, reader);
}

/// Two integers, each in [1, max], as "AxB"; `expected`: "width x height", `example`: "512x384".
CLI::Option* add_sides(CLI::App& app, const std::string& name, const std::string& type_name,
                       const std::string& expected, uint32_t max, const std::string& example,
                       const std::string& description,
                       std::function<void(uint32_t a, uint32_t b)> store);

/// Rows and columns, each in [1, max], as "RxC"; the help shows those that are set now.
CLI::Option* add_rows_by_cols(CLI::App& app, const std::string& name, uint32_t& rows,
                              uint32_t& cols, uint32_t max, const std::string& description);

/// --grid RxC, --names PATTERN and --order: what names in a folder of views mean.
void add_naming(CLI::App& app, io::ViewNaming& target);

/// Usage failure for the first of these options that is given: "OPTION does not apply: WHY".
void refuse_given(std::initializer_list<std::pair<const char*, bool>> options,
                  const std::string& why);

/// The same for what `naming` has of --grid, --names and --order.
void refuse_naming(const io::ViewNaming& naming, const std::string& why);

/// --views R0..R1:STEP,C0..C1:STEP: a part of the grid. ":STEP" may be left out; one number stands
/// for a range of one.
CLI::Option* add_views(CLI::App& app, std::optional<io::ViewPart>& target);

/// --view ROW,COL.
CLI::Option* add_view(CLI::App& app, std::optional<ViewPos>& target,
                      const std::string& description);

/// --rect X,Y,W,H.
CLI::Option* add_rect(CLI::App& app, std::optional<Rect>& target);

/// --levels N: levels of the tree to use, from the top.
CLI::Option* add_levels(CLI::App& app, std::optional<int>& target);

/// --threads N, 0 for all cores.
CLI::Option* add_threads(CLI::App& app, int& target);

/// --json.
CLI::Option* add_json(CLI::App& app, bool& target);

/// -o, --output: a required path; and --force.
CLI::Option* add_output(CLI::App& app, std::filesystem::path& target, bool& force,
                        const std::string& type_name, const std::string& description);

/// --force.
void add_force(CLI::App& app, bool& force);

/// A required path.
CLI::Option* add_path(CLI::App& app, const std::string& name, std::filesystem::path& target,
                      const std::string& description);

/// --suite: the folder of the conformance suite. Without it `target` becomes the folder vectors, or
/// where there is no suite, the one that is installed with this program.
CLI::Option* add_suite(CLI::App& app, std::filesystem::path& target,
                       const std::string& description);

/// --milestone: only the vectors of one (tools/vectors/milestone.hpp).
CLI::Option* add_milestone(CLI::App& app, std::string& target);

/// A positional FILE: an .hmlfc file.
CLI::Option* add_stream(CLI::App& app, std::filesystem::path& target);

}  // namespace hmlfc::cli
