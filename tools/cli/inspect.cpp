// hmlfc inspect: how one block is decoded, field by field and stage by stage.
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "cli/block_report_json.hpp"
#include "cli/block_report_text.hpp"
#include "cli/commands.hpp"
#include "cli/output.hpp"
#include "cli/stream_file.hpp"

namespace hmlfc::cli {
namespace {

struct InspectOptions {
  std::filesystem::path file;
  std::optional<ViewPos> view;
  Plane plane = Plane::kY;
  std::array<uint32_t, 2> block{};
  std::optional<int> levels;
  bool json = false;
};

void check_block(const StreamFile& file, const InspectOptions& options) {
  const PlaneSize size = file.decoder().plane_size(options.plane);
  const uint32_t side = file.header().block_size();
  const uint32_t columns = (size.width + side - 1) / side;
  const uint32_t rows = (size.height + side - 1) / side;
  if (options.block[0] < columns && options.block[1] < rows) return;
  throw Failure(
      ExitCode::kUsage,
      fmt::format("--block {},{} is outside the {} columns and {} rows of blocks of plane {}",
                  options.block[0], options.block[1], columns, rows, plane_name(options.plane)));
}

ExitCode run_inspect(const InspectOptions& options) {
  const StreamFile file(options.file);
  file.check_view(*options.view);
  check_block(file, options);
  const int stop_level = options.levels ? file.stop_level(*options.levels) : 0;
  BlockReport report;
  report.file = options.file.string();
  report.header = file.header();
  report.block = {*options.view, options.plane, options.block[0], options.block[1]};
  value_or_throw(file.decoder().decode_block(
                     report.block,
                     {.stop_level = stop_level, .trace = &report.trace, .counts = &report.counts}),
                 options.file);
  if (options.json) {
    print_json(to_json(report));
  } else {
    print(to_text(report));
  }
  return ExitCode::kDone;
}

CLI::Option* add_block(CLI::App& app, std::array<uint32_t, 2>& target) {
  const auto reader = [&target](const std::string& text) -> std::optional<std::string> {
    const auto numbers = parse_numbers<2>(text, ',');
    if (!numbers) return "block column,block row, as 3,5";
    target = *numbers;
    return std::nullopt;
  };
  return add_value(app, "--block", "BX,BY", "Column and row of the block; counted from 0,0",
                   reader);
}

}  // namespace

void add_inspect(CLI::App& program, Task& task) {
  const auto options = std::make_shared<InspectOptions>();
  CLI::App* app = program.add_subcommand("inspect", "Show how one block is decoded");
  add_path(*app, "FILE", options->file, "An .hmlfc file");
  add_view(*app, options->view, "The view; counted from 0,0")->required();
  add_choice(*app, "--plane", options->plane,
             {{"Y", Plane::kY}, {"Co", Plane::kCo}, {"Cg", Plane::kCg}}, "The plane")
      ->required();
  add_block(*app, options->block)->required();
  add_levels(*app, options->levels);
  app->add_flag("--json", options->json, "Print JSON");
  app->footer(
      R"(For each level, from the top: every field that is read, with its address from the start of the
file, its value and the clause of the specification that defines it; then the values of each stage.
Addresses of values in bounded integer sequences are those of the sequence. References are decoded on
demand, as by a decoder that keeps nothing.

JSON keys: view, plane, block, levels[]{level, image, kind, state, fields[]{section, byte, bit, bits,
name, clause, value}, reference_blocks[]{image, block, fields}, stages{}{clause, values}}, cost{walks,
fields, bits, bytes, steps}. In streams with motion tiles a level may have motion_fields[] and
disparity{image, fields[]} too.

Example:
  hmlfc inspect chess.hmlfc --view 3,5 --plane Y --block 10,7)");
  app->callback([&task, options] { task = [options] { return run_inspect(*options); }; });
}

}  // namespace hmlfc::cli
