// Parts of a grid of views, and the sentences for those that reach beyond it.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

#include "io/view_list.hpp"

namespace hmlfc::io {
namespace {

constexpr uint32_t kLargest = std::numeric_limits<uint32_t>::max();

ViewList grid_of(uint32_t rows, uint32_t cols) {
  ViewList list{rows, cols, {}};
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t col = 0; col < cols; ++col) {
      list.files.emplace_back(std::to_string(row) + "_" + std::to_string(col));
    }
  }
  return list;
}

/// "ROWSxCOLS: names" of `part` of a grid in folder "views", or the error.
std::string part_text(uint32_t rows, uint32_t cols, const ViewPart& part) {
  const auto views = part_of("views", grid_of(rows, cols), part);
  if (!views) return views.error().message;
  std::string text = std::to_string(views->rows) + "x" + std::to_string(views->cols) + ":";
  for (const auto& file : views->files) text += " " + file.string();
  return text;
}

TEST(ViewPart, RowsAndColumnsByTheirSteps) {
  EXPECT_EQ(part_text(3, 4, {{1, 2}, {1, 3}}), "2x3: 1_1 1_2 1_3 2_1 2_2 2_3");
  EXPECT_EQ(part_text(2, 3, {{0, 1}, {0, 2}}), "2x3: 0_0 0_1 0_2 1_0 1_1 1_2");
  EXPECT_EQ(part_text(4, 8, {{0, 2, 2}, {1, 7, 3}}), "2x3: 0_1 0_4 0_7 2_1 2_4 2_7");
  EXPECT_EQ(part_text(4, 8, {{0, 3, 2}, {1, 6, 3}}), "2x2: 0_1 0_4 2_1 2_4") << "passes the last";
  EXPECT_EQ(part_text(4, 8, {{1, 3, kLargest}, {0, 7, kLargest}}), "1x1: 1_0");
}

TEST(ViewPart, RangesThatEndBeyondTheGrid) {
  const std::string asks = "views: --views asks for ";
  const std::string row = asks + "row 3, but the grid has 3 rows (0 to 2)";
  EXPECT_EQ(part_text(3, 4, {{0, 3}, {0, 4}}), row);
  EXPECT_EQ(part_text(3, 4, {{0, 3, 2}, {0, 3}}), row) << "its steps do not";
  EXPECT_EQ(part_text(3, 4, {{0, 2}, {4, 4}}),
            asks + "column 4, but the grid has 4 columns (0 to 3)");
  EXPECT_EQ(part_text(1, 2, {{0, 1}, {0, 1}}), asks + "row 1, but the grid has 1 row (number 0)");
  EXPECT_EQ(part_text(3, 4, {{kLargest, kLargest}, {0, 3}}),
            asks + "row 4294967295, but the grid has 3 rows (0 to 2)");
}

}  // namespace
}  // namespace hmlfc::io
