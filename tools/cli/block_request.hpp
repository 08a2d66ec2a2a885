// One block that a user asks for, and the report on it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <hmlfc/format.hpp>

#include "cli/arguments.hpp"
#include "cli/block_report.hpp"
#include "cli/view_source.hpp"

namespace hmlfc::cli {

/// A block by its options.
struct BlockRequest {
  std::optional<ViewPos> view;
  Plane plane = Plane::kY;
  std::array<uint32_t, 2> block{};  ///< column, row
  std::optional<int> levels;        ///< of the tree, from the top; else all
};

/// Adds --plane: Y, Co or Cg.
CLI::Option* add_plane(CLI::App& app, Plane& plane);

/// Adds --view, --plane, --block and --levels. Unless `required`, none need be given; then
/// `request.view` stays empty.
void add_block_options(CLI::App& app, BlockRequest& request, bool required = true);

/// Usage failure unless the view is in the grid and the block in its plane.
void check_place(const StreamFile& file, const BlockRequest& request);

/// Decodes the block into `report`. Usage failures: the place is not in the stream. Returns the
/// error of a corrupt block; `report` then has what was read before it.
Result<void> report_on_block(const StreamFile& file, const BlockRequest& request,
                             BlockReport& report);

}  // namespace hmlfc::cli
