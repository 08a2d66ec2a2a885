#include "io/view_part.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace hmlfc::io {

namespace {

uint32_t length(const IndexRange& range) { return (range.last - range.first) / range.step + 1; }

// "row 17, but the grid has 17 rows (0 to 16)" where `range` ends beyond `count` rows; `unit` is
// "row" or "column".
std::optional<std::string> describe_excess(const IndexRange& range, uint32_t count,
                                           const std::string& unit) {
  if (range.last < count) return std::nullopt;
  return unit + " " + std::to_string(range.last) + ", but the grid has " + std::to_string(count) +
         " " + unit + (count == 1 ? " (number 0)" : "s (0 to " + std::to_string(count - 1) + ")");
}

}  // namespace

IoResult<ViewList> part_of(const std::filesystem::path& folder, const ViewList& views,
                           const ViewPart& part) {
  auto excess = describe_excess(part.rows, views.rows, "row");
  if (!excess) excess = describe_excess(part.cols, views.cols, "column");
  if (excess) return file_error(folder, "--views asks for " + *excess);

  ViewList result{length(part.rows), length(part.cols), {}, views.folder, {}};
  for (uint32_t i = 0; i < result.rows; ++i) {
    const size_t row = part.rows.first + size_t{i} * part.rows.step;
    for (uint32_t j = 0; j < result.cols; ++j) {
      const size_t col = part.cols.first + size_t{j} * part.cols.step;
      result.files.push_back(views.files[row * views.cols + col]);
    }
  }
  return result;
}

}  // namespace hmlfc::io
