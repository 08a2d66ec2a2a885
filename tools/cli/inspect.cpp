// hmlfc inspect: shows how one block is decoded, field by field and stage by stage.
#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/arguments.hpp"
#include "cli/block_report.hpp"
#include "cli/view_source.hpp"

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
  report.plane_size = file.decoder().plane_size(options.plane);
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

}  // namespace

void add_inspect(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "inspect", "Show how one block is decoded", run_inspect,
      R"(For each level, from the top: every field that is read, with its address from the start of the
file, its value and the clause of the specification that defines it; the motion vectors in samples of
the block's plane; the values of each stage in sample steps. Values in bounded integer sequences have
the address of the sequence. Reference blocks are decoded on demand, as by a decoder without a cache.

JSON keys: view, plane, block, levels[]{level, image, kind, state, fields[]{section, byte, bit, bits,
name, clause, value}, vectors[]{image, x, y, unit, clause}, reference_blocks[]{image, block, fields},
stages{}{clause, values}}, cost{walks, fields, bits, bytes, steps}. In streams with motion tiles a
level may also have motion_fields[] and disparity{image, fields[]}.

Example:
  hmlfc inspect chess.hmlfc --view 3,5 --plane Y --block 10,7)");
  add_stream(app, options.file);
  add_view(app, options.view, "The view; counted from 0,0")->required();
  add_choice(app, "--plane", options.plane,
             {{"Y", Plane::kY}, {"Co", Plane::kCo}, {"Cg", Plane::kCg}}, "The plane")
      ->required();
  add_numbers<2>(app, "--block", "BX,BY", ',', "block column,block row, such as 3,5",
                 "Column and row of the block; counted from 0,0",
                 [&block = options.block](const auto& numbers) { block = numbers; })
      ->required();
  add_levels(app, options.levels);
  add_json(app, options.json);
}

}  // namespace hmlfc::cli
