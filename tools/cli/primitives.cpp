// hmlfc primitives: cases of single operations for a decoder that is being written.
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/arguments.hpp"
#include "primitives/cases.hpp"
#include "primitives/check.hpp"

namespace hmlfc::cli {
namespace {

using primitives::Primitive;

struct PrimitiveOptions {
  const Primitive* primitive = nullptr;
  primitives::Request request;
  uint32_t errors = 20;
  bool json = false;
};

std::string inputs_of(const Primitive& primitive) {
  std::string names;
  for (const auto& column : primitive.columns) names += column.name + " ";
  return names + (primitive.bytes.range.empty() ? "" : "bytes ");
}

std::string kind_of(const Primitive& primitive) { return primitive.exhaustive() ? "all" : "drawn"; }

Json description(const Primitive& primitive) {
  Json inputs = Json::array();
  for (const auto& column : primitive.columns) {
    inputs.push_back({{"name", column.name}, {"range", column.range}});
  }
  if (!primitive.bytes.range.empty()) {
    inputs.push_back({{"name", "bytes"}, {"range", primitive.bytes.range}});
  }
  return {{"name", primitive.name},
          {"clauses", primitive.clauses},
          {"cases", count_cases(primitive, {})},
          {"exhaustive", primitive.exhaustive()},
          {"inputs", inputs},
          {"results", primitive.results}};
}

void print_ranges(const Primitive& primitive) {
  for (const auto& column : primitive.columns) {
    print(fmt::format("  {:<22} {}\n", column.name, column.range));
  }
  if (!primitive.bytes.range.empty()) {
    print(fmt::format("  {:<22} {}\n", "bytes", primitive.bytes.range));
  }
}

ExitCode run_list(const PrimitiveOptions& options) {
  Json all = Json::array();
  for (const Primitive& primitive : primitives::all_primitives()) {
    if (options.primitive != nullptr && options.primitive != &primitive) continue;
    if (options.json) {
      all.push_back(description(primitive));
      continue;
    }
    print(fmt::format("{:<18} {:>6} {:<6} {}\n", primitive.name, count_cases(primitive, {}),
                      kind_of(primitive), primitive.clauses));
    print(fmt::format("  {}-> {}\n", inputs_of(primitive), primitive.results));
    if (options.primitive != nullptr) print_ranges(primitive);
  }
  if (options.json) print_json(all);
  return ExitCode::kDone;
}

void check_count(const PrimitiveOptions& options) {
  if (options.request.count && options.primitive->exhaustive()) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("--count: {} always has all its {} cases", options.primitive->name,
                              count_cases(*options.primitive, {})));
  }
}

ExitCode run_gen(const PrimitiveOptions& options) {
  check_count(options);
  primitives::Cases cases(*options.primitive, options.request);
  while (cases.next()) print(line_of(*options.primitive, cases.inputs()) + "\n");
  return ExitCode::kDone;
}

ExitCode run_check(const PrimitiveOptions& options) {
  check_count(options);
  const auto verdict =
      primitives::check(*options.primitive, options.request, std::cin, options.errors,
                        [](const std::string& error) { print(error + "\n"); });
  const std::string& name = options.primitive->name;
  if (verdict.errors == 0) {
    print(fmt::format("{}: {} cases, all right\n", name, verdict.cases));
    return ExitCode::kDone;
  }
  print(fmt::format("{}: {} of {} cases compared, errors: {}\n", name, verdict.compared,
                    verdict.cases, verdict.errors));
  return ExitCode::kDifferent;
}

CLI::Option* add_name(CLI::App& app, PrimitiveOptions& options) {
  std::string names;
  for (const Primitive& primitive : primitives::all_primitives()) names += " " + primitive.name;
  const auto reader = [&options](const std::string& text) {
    options.primitive = primitives::find_primitive(text);
    return options.primitive != nullptr;
  };
  return add_value(app, "NAME", "", "A primitive", "one of" + names, reader);
}

void add_request(CLI::App& app, primitives::Request& request) {
  add_integer(app, "--seed", request.seed, 0u, UINT64_MAX, "Other cases, where they are drawn");
  add_integer(app, "--count", request.count, 1u, 1u << 24, "Cases, where they are drawn");
  add_integer(app, "--level", request.level, 1, 2, "2: 32 times as many drawn cases");
}

}  // namespace

void add_primitives(CLI::App& program, Task& task) {
  CLI::App* app =
      program.add_subcommand("primitives", "Test single operations of a decoder being written");
  app->require_subcommand(1);
  app->footer("Example:\n  hmlfc primitives list");

  const auto [list, listed] = add_command(
      *app, task, "list", "List the primitives: cases, clauses, inputs and results", run_list,
      R"(With NAME also what each input may be. Cases are all that there are, or drawn at random.

Example:
  hmlfc primitives list colour)");
  add_name(list, listed);
  add_json(list, listed.json);

  const auto [gen, generated] =
      add_command(*app, task, "gen", "Print cases, one a line: the inputs alone", run_gen,
                  R"(Integers are decimal, bytes hexadecimal ("-" where there are none).

Example:
  hmlfc primitives gen colour --count 3)");
  add_name(gen, generated)->required();
  add_request(gen, generated.request);

  const auto [check, checked] = add_command(
      *app, task, "check", "Compare results with those of the golden model", run_check,
      R"(Reads the lines of gen, each with the results behind the inputs, from standard input. It needs the
same --seed, --count and --level as gen. A line that is missing, too many or out of place is an error.

Exit status: 0 all right, 1 an error.

Example:
  hmlfc primitives check colour < results)");
  add_name(check, checked)->required();
  add_request(check, checked.request);
  add_integer(check, "--errors", checked.errors, 1u, UINT32_MAX, "Stop after so many errors");
}

}  // namespace hmlfc::cli
