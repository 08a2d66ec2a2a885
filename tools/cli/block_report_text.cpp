#include "cli/block_report.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include <fmt/format.h>

#include <hmlfc/stream_info.hpp>

#include "arithmetic/bise.hpp"
#include "arithmetic/reconstruct.hpp"
#include "arithmetic/widths.hpp"
#include "cli/stream_report.hpp"

namespace hmlfc::cli {
namespace {

constexpr size_t kLineColumns = 112;
constexpr size_t kGap = 2;

// "+ 3" or "- 3".
std::string signed_term(int64_t value) {
  return value < 0 ? fmt::format("- {}", -value) : fmt::format("+ {}", value);
}

bool is_negative(const TracedWalk& walk) {
  const auto mode = walk.last_value("sign_mode");
  return mode == 1 || walk.last_value("sign").value_or(0) == 1;
}

// The sign of the palette entry that the block's index names (MOT-3); + in an empty tile.
bool is_negative_entry(const TracedWalk& motion) {
  const int64_t index = motion.last_value("index").value_or(-1);
  int64_t entry = -1;
  for (const FieldRecord& field : motion.fields) {
    if (field.name == "choice") ++entry;
    if (field.name == "sign" && entry == index) return field.value != 0;
  }
  return false;
}

// DEC-3 with motion: `keyed` levels do not use the parent (EXT-5).
std::string prediction_formula(const TracedLevel& level, bool keyed, const SampleRange& range) {
  const TracedWalk* motion = level.walk(TileKind::kMotion);
  const TracedWalk& own = *level.own_walk();
  const bool negative = motion != nullptr ? is_negative_entry(*motion) : is_negative(own);
  std::string text;
  for (const VectorRecord& vector : level.vectors) {
    text += fmt::format("  vector     = ({}, {}) samples, to image {},{}  {}\n", vector.x / 8.0,
                        vector.y / 8.0, vector.image_row, vector.image_col, vector.clause);
  }
  return text + fmt::format("  prediction = clamp({} {} reference, {}, {})\n",
                            keyed ? "0" : "parent", negative ? '-' : '+', range.lo, range.hi);
}

// TIL-10 or STP-3.
std::string residual_formula(const TracedWalk& own, const SampleRange& range) {
  const uint32_t count = levels_of_code(own.level_code().value_or(0)).count;
  const std::string coded =
      fmt::format("clamp(value - {} {}, {}, {})", count >> 1,
                  signed_term(own.last_value("bias").value_or(0)), -range.bound, range.bound);
  const auto step_code = own.step_code();
  if (!step_code) return fmt::format("  residual   = {}\n", coded);
  return fmt::format("  residual   = clamp({} * {}, {}, {})\n", step_of_code(*step_code), coded,
                     -range.bound, range.bound);
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
    for (const FieldRecord& field : level.own_walk()->fields) {
      if (field.name == "value") raw.values.push_back(static_cast<int32_t>(field.value));
    }
    squares.push_back(std::move(raw));
  }
  for (const RecordedStage& stage : level.stages) {
    squares.push_back({stage.stage + " " + stage.clause, stage.values});
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

std::string level_text(const TracedLevel& level, const StreamHeader& header, Plane plane) {
  std::string text =
      fmt::format("\nLevel {}, image {},{}, {}\n", level.site.level, level.site.image_row,
                  level.site.image_col, describe_image(level, header));
  for (const TracedWalk& walk : level.walks) {
    const bool own = walk.site == level.site;
    if (!own || level.walks.front().site != level.site) {
      text += "  " + describe_walk(level, walk) + "\n";
    }
    text += field_table(walk, header, own ? 2 : 4);
  }
  text += formulas(level, header, plane);
  const std::vector<Square> squares = squares_of(level);
  return text + square_table(squares, header.block_size(), cell_width(squares));
}

std::string heading(const BlockReport& report) {
  const BlockAddress& block = report.block;
  const unsigned size = report.header.block_size();
  const PlaneSize& plane = report.plane_size;
  const uint32_t x = block.bx * size;
  const uint32_t y = block.by * size;
  return fmt::format("Block {},{} of plane {} of view {},{}: samples x {}..{}, y {}..{}\n{}: {}\n",
                     block.bx, block.by, plane_name(block.plane), block.view.row, block.view.col, x,
                     std::min(x + size, plane.width) - 1, y, std::min(y + size, plane.height) - 1,
                     report.file, describe_coding(report.header));
}

}  // namespace

std::string describe_image(const TracedLevel& level, const StreamHeader& header) {
  const ImageInfo image =
      image_info(header, level.site.level, level.site.image_row, level.site.image_col);
  if (image.kind == ImageKind::kKey) return "key image";
  if (image.kind == ImageKind::kReference) {
    return fmt::format("reference image: {}", state_name(level.state()));
  }
  return fmt::format("predictive image of reference {},{}: {}", image.ref_row, image.ref_col,
                     state_name(level.state()));
}

std::string describe_walk(const TracedLevel& level, const TracedWalk& walk) {
  const BlockSite& site = walk.site;
  if (level.is_reference(walk)) {
    const bool residual = walk.last_value("value").has_value();
    return fmt::format("Block {},{} of reference image {},{}: {}", site.bx, site.by, site.image_row,
                       site.image_col,
                       state_name(residual ? BlockState::kResidual : BlockState::kZero));
  }
  if (site.tile == TileKind::kDisparity) {
    return fmt::format("The {} of reference image {},{}", tile_kind_name(site.tile), site.image_row,
                       site.image_col);
  }
  return fmt::format("Its {}", tile_kind_name(site.tile));
}

std::string formulas(const TracedLevel& level, const StreamHeader& header, Plane plane) {
  std::string text;
  if (level.own_walk() == nullptr) return text;
  const SampleRange range = sample_range(plane, header.depth);
  if (level.stage("reference") != nullptr) {
    const bool keyed = level_info(header, level.site.level).key_images > 0;
    text += prediction_formula(level, keyed, range);
  }
  if (level.stage("residual") != nullptr) {
    text += residual_formula(*level.own_walk(), range);
    text +=
        fmt::format("  sample     = clamp(prediction + residual, {}, {})\n", range.lo, range.hi);
  }
  return text;
}

std::string to_text(const BlockReport& report) {
  std::string text = heading(report);
  for (const TracedLevel& level : report.trace.levels()) {
    text += level_text(level, report.header, report.block.plane);
  }
  const AccessCounts& counts = report.counts;
  const bool motion_tiles = report.header.has(Feature::kMotionTiles);
  const int tree_height = report.header.tree_height;
  text += fmt::format(
      "\nCost: {} walks (at most {}, {}), {} fields of {} bits = {} bytes, {} serial steps (at "
      "most 63 a walk, BND-1)\n",
      counts.walks, motion_tiles ? 11 * tree_height + 3 : 5 * tree_height + 1,
      motion_tiles ? "BND-3" : "BND-2", counts.fields, counts.bits, (counts.bits + 7) / 8,
      counts.steps);
  return text;
}

}  // namespace hmlfc::cli
