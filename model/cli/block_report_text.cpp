#include "cli/block_report_text.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "cli/field_table.hpp"
#include "cli/stream_report.hpp"
#include "fields/geometry.hpp"
#include "values/levels.hpp"
#include "values/sample_range.hpp"

namespace hmlfc::cli {
namespace {

constexpr size_t kLineColumns = 112;
constexpr size_t kGap = 2;

std::optional<int64_t> last_value(const TracedWalk& walk, std::string_view name) {
  std::optional<int64_t> value;
  for (const TracedField& field : walk.fields) {
    if (field.name == name) value = field.value;
  }
  return value;
}

// "+ 3" or "- 3".
std::string signed_term(int64_t value) {
  return value < 0 ? fmt::format("- {}", -value) : fmt::format("+ {}", value);
}

bool is_negative(const TracedWalk& walk) {
  const auto mode = last_value(walk, "sign_mode");
  return mode == 1 || last_value(walk, "sign").value_or(0) == 1;
}

// The arithmetic of DEC-3 and TIL-10 with this block's numbers.
std::string formulas(const TracedLevel& level, const SampleRange& range) {
  const TracedWalk& walk = level.walks.front();
  std::string text;
  if (level.stage("reference") != nullptr) {
    text += fmt::format(
        "  prediction = clamp(parent {} reference, {}, {}), reference at (x {}, y {})\n",
        is_negative(walk) ? '-' : '+', range.lo, range.hi,
        signed_term(last_value(walk, "dx").value_or(0)),
        signed_term(last_value(walk, "dy").value_or(0)));
  }
  if (level.stage("residual") != nullptr) {
    const int64_t code =
        last_value(walk, "level_base").value_or(0) + last_value(walk, "level_delta").value_or(0);
    const uint32_t count = levels_of_code(static_cast<unsigned>(code)).count;
    text +=
        fmt::format("  residual   = clamp(value - {} {}, {}, {})\n", count >> 1,
                    signed_term(last_value(walk, "bias").value_or(0)), -range.bound, range.bound);
    text +=
        fmt::format("  sample     = clamp(prediction + residual, {}, {})\n", range.lo, range.hi);
  }
  return text;
}

// A titled square of numbers.
struct Square {
  std::string title;
  std::vector<int32_t> values;
};

std::vector<Square> squares_of(const TracedLevel& level) {
  std::vector<Square> squares;
  if (level.stage("residual") != nullptr) {
    Square raw{"value TIL-9", {}};
    for (const TracedField& field : level.walks.front().fields) {
      if (field.name == "value") raw.values.push_back(static_cast<int32_t>(field.value));
    }
    squares.push_back(std::move(raw));
  }
  for (const TracedStage& stage : level.stages) {
    squares.push_back({stage.name + " " + stage.clause, stage.values});
  }
  return squares;
}

size_t cell_width(const std::vector<Square>& squares) {
  size_t width = 0;
  for (const Square& square : squares) {
    for (const int32_t value : square.values) {
      width = std::max(width, std::to_string(value).size() + 1);
    }
  }
  return width;
}

// Columns that a square takes with the gap behind it.
size_t width_of(const Square& square, size_t side, size_t cell) {
  return std::max(side * cell, square.title.size() + 1) + kGap;
}

// `squares` side by side.
std::string square_line(std::span<const Square> squares, size_t side, size_t cell) {
  std::vector<std::string> lines(side + 1);
  for (const Square& square : squares) {
    const size_t width = width_of(square, side, cell);
    lines[0] += fmt::format("{:<{}}", " " + square.title, width);
    for (size_t y = 0; y < side; ++y) {
      std::string row;
      for (size_t x = 0; x < side; ++x) {
        row += fmt::format("{:>{}}", square.values[y * side + x], cell);
      }
      lines[y + 1] += fmt::format("{:<{}}", row, width);
    }
  }
  std::string text;
  for (std::string& line : lines) {
    line.erase(line.find_last_not_of(' ') + 1);
    text += "  " + line + "\n";
  }
  return text;
}

// As many squares side by side as a line holds, at least one.
std::string square_table(std::span<const Square> squares, size_t side, size_t cell) {
  std::string text;
  while (!squares.empty()) {
    size_t count = 0;
    size_t columns = 0;
    while (count < squares.size()) {
      columns += width_of(squares[count], side, cell);
      if (count > 0 && columns > kLineColumns) break;
      ++count;
    }
    text += square_line(squares.first(count), side, cell);
    squares = squares.subspan(count);
  }
  return text;
}

std::string describe_image(const TracedLevel& level, const Geometry& geometry) {
  const ImagePos at{level.site.image_row, level.site.image_col};
  if (geometry.is_key(level.site.level, at)) return "key image";
  const ImagePos reference = geometry.reference_of(level.site.level, at);
  if (reference == at) return fmt::format("reference image: {}", state_name(level.state()));
  return fmt::format("predictive image of reference {},{}: {}", reference.row, reference.col,
                     state_name(level.state()));
}

std::string level_text(const TracedLevel& level, const Geometry& geometry,
                       const SampleRange& range) {
  std::string text =
      fmt::format("\nLevel {}, image {},{}, {}\n", level.site.level, level.site.image_row,
                  level.site.image_col, describe_image(level, geometry));
  for (size_t i = 0; i < level.walks.size(); ++i) {
    const TracedWalk& walk = level.walks[i];
    if (i > 0) {
      const bool residual = last_value(walk, "value").has_value();
      text += fmt::format("  Block {},{} of reference image {},{}: {}\n", walk.site.bx,
                          walk.site.by, walk.site.image_row, walk.site.image_col,
                          state_name(residual ? BlockState::kResidual : BlockState::kZero));
    }
    text += field_table(field_rows(walk), i > 0 ? 4 : 2);
  }
  if (!level.walks.empty()) text += formulas(level, range);
  const std::vector<Square> squares = squares_of(level);
  return text + square_table(squares, geometry.block_size(), cell_width(squares));
}

std::string heading(const BlockReport& report, const Geometry& geometry) {
  const BlockAddress& block = report.block;
  const unsigned size = geometry.block_size();
  const PlaneShape& plane = geometry.plane(block.plane);
  const uint32_t x = block.bx * size;
  const uint32_t y = block.by * size;
  return fmt::format("Block {},{} of plane {} of view {},{}: samples x {}..{}, y {}..{}\n{}: {}\n",
                     block.bx, block.by, plane_name(block.plane), block.view.row, block.view.col, x,
                     std::min(x + size, plane.width) - 1, y, std::min(y + size, plane.height) - 1,
                     report.file, describe_coding(report.header));
}

}  // namespace

std::string to_text(const BlockReport& report) {
  const Geometry geometry(report.header);
  const SampleRange range = sample_range(report.block.plane, report.header.depth);
  std::string text = heading(report, geometry);
  for (const TracedLevel& level : report.trace.levels()) {
    text += level_text(level, geometry, range);
  }
  const AccessCounts& counts = report.counts;
  text += fmt::format(
      "\nCost: {} walks (at most {}, BND-2), {} fields of {} bits = {} bytes, {} serial steps (at "
      "most 63 a walk, BND-1)\n",
      counts.walks, 5 * report.header.tree_height + 1, counts.fields, counts.bits,
      (counts.bits + 7) / 8, counts.steps);
  return text;
}

}  // namespace hmlfc::cli
