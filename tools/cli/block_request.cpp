#include "cli/block_request.hpp"

#include <fmt/format.h>

namespace hmlfc::cli {

CLI::Option* add_plane(CLI::App& app, Plane& plane) {
  return add_choice(app, "--plane", plane,
                    {{"Y", Plane::kY}, {"Co", Plane::kCo}, {"Cg", Plane::kCg}}, "The plane")
      ->required();
}

void add_block_options(CLI::App& app, BlockRequest& request, bool required) {
  CLI::Option* view = add_view(app, request.view, "The view; counted from 0,0");
  CLI::Option* plane = add_plane(app, request.plane)->required(required);
  CLI::Option* block =
      add_numbers<2>(app, "--block", "BX,BY", ',', "block column,block row, such as 3,5",
                     "Column and row of the block; counted from 0,0",
                     [&at = request.block](const auto& numbers) { at = numbers; });
  CLI::Option* levels = add_levels(app, request.levels);
  view->required(required)->needs(block);
  block->required(required)->needs(view);
  plane->needs(view);
  levels->needs(view);
}

void check_place(const StreamFile& file, const BlockRequest& request) {
  file.check_view(*request.view);
  const PlaneSize size = file.decoder().plane_size(request.plane);
  const uint32_t side = file.header().block_size();
  const uint32_t columns = (size.width + side - 1) / side;
  const uint32_t rows = (size.height + side - 1) / side;
  if (request.block[0] < columns && request.block[1] < rows) return;
  throw Failure(
      ExitCode::kUsage,
      fmt::format("--block {},{} does not exist: plane {} has columns 0 to {}, rows 0 to {}",
                  request.block[0], request.block[1], plane_name(request.plane), columns - 1,
                  rows - 1));
}

Result<void> report_on_block(const StreamFile& file, const BlockRequest& request,
                             BlockReport& report) {
  check_place(file, request);
  const int stop_level = request.levels ? file.stop_level(*request.levels) : 0;
  report.file = file.path().string();
  report.header = file.header();
  report.plane_size = file.decoder().plane_size(request.plane);
  report.block = {*request.view, request.plane, request.block[0], request.block[1]};
  const auto block = file.decoder().decode_block(
      report.block, {.stop_level = stop_level, .trace = &report.trace, .counts = &report.counts});
  if (!block) return tl::unexpected(block.error());
  return {};
}

}  // namespace hmlfc::cli
