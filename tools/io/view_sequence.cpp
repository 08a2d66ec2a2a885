#include "io/view_sequence.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "io/view_list_text.hpp"
#include "io/view_name.hpp"

namespace hmlfc::io {
namespace {

// The number that is another one in each picture.
std::optional<NumberColumn> counter_of(const std::vector<NamedPicture>& pictures) {
  for (NumberColumn& column : number_columns(pictures)) {
    if (column.values.size() == pictures.size()) return std::move(column);
  }
  return std::nullopt;
}

// The first of the numbers that `wanted` pictures should have.
int64_t first_number(const NumberColumn& counter, int64_t wanted, bool from_0) {
  if (from_0) return 0;
  return counter.values.back() == wanted ? 1 : counter.values.front();
}

// ": row 1, column 1 (a04.png)" for numbers that are missing; "" where that is not known.
std::string describe_gaps(const std::vector<NamedPicture>& pictures, const NumberColumn& counter,
                          GridShape grid, FrameOrder order, bool from_0) {
  const int64_t wanted = int64_t{grid.rows} * grid.cols;
  const int64_t first = first_number(counter, wanted, from_0);
  if (counter.values.front() < first || counter.values.back() >= first + wanted) return "";
  std::string text;
  size_t named = 0;
  auto next = counter.values.begin();
  for (int64_t value = first; value < first + wanted; ++value) {
    if (next != counter.values.end() && *next == value) {
      ++next;
      continue;
    }
    if (++named > 3) return text + " ...";
    const auto at = view_of_frame(static_cast<size_t>(value - first), grid, order);
    text += (named == 1 ? ": " : ", ") + describe_place(at) + " (" +
            name_with(pictures, {{counter.number, value}}) + ")";
  }
  return text;
}

std::string describe_count(const std::vector<NamedPicture>& pictures,
                           const std::optional<NumberColumn>& counter, GridShape grid,
                           FrameOrder order, bool from_0) {
  const size_t wanted = size_t{grid.rows} * grid.cols;
  std::string text = fmt::format("{} picture{} for a {} grid of {} views", pictures.size(),
                                 pictures.size() == 1 ? "" : "s", describe(grid), wanted);
  if (pictures.size() > wanted) {
    return text + ": " + shown_name(pictures[wanted]) + " is the first one too many";
  }
  const size_t total = wanted - pictures.size();
  text += fmt::format("; {} {} missing", total, total == 1 ? "is" : "are");
  const std::string gaps =
      counter ? describe_gaps(pictures, *counter, grid, order, from_0) : std::string();
  if (!gaps.empty()) return text + gaps;
  return text + ": after " + shown_name(pictures.back()) + " the view of " +
         describe_place(view_of_frame(pictures.size(), grid, order));
}

std::string describe_order(const std::vector<NamedPicture>& sorted,
                           const std::optional<NumberColumn>& counter, GridShape grid,
                           FrameOrder order) {
  const std::string_view word = kFrameOrders[static_cast<size_t>(order)].first;
  std::string text = describe(grid) + " views in the ";
  if (counter) {
    text += fmt::format("order of number {} of the names ({})", counter->number + 1,
                        describe_values(*counter));
  } else {
    text += fmt::format("sorted order of the names, {} to {}", shown_name(sorted.front()),
                        shown_name(sorted.back()));
  }
  return text +
         fmt::format(", {}", order == FrameOrder::kRaster ? std::string_view("row by row") : word);
}

}  // namespace

tl::expected<ViewSequence, std::string> sequence_of(const std::vector<NamedPicture>& pictures,
                                                    GridShape grid, FrameOrder order, bool from_0) {
  const auto counter = counter_of(pictures);
  std::vector<size_t> sorted(pictures.size());
  std::iota(sorted.begin(), sorted.end(), size_t{0});
  if (counter) std::ranges::sort(sorted, {}, [&](size_t i) { return counter->ranks[i]; });
  if (pictures.size() != size_t{grid.rows} * grid.cols) {
    return tl::unexpected(describe_count(pictures, counter, grid, order, from_0));
  }
  ViewSequence sequence{std::vector<std::filesystem::path>(pictures.size()),
                        describe_order(pictures, counter, grid, order)};
  for (size_t i = 0; i < sorted.size(); ++i) {
    const GridPosition at = view_of_frame(i, grid, order);
    sequence.files[size_t{at.row} * grid.cols + at.col] = pictures[sorted[i]].file;
  }
  return sequence;
}

std::optional<GridShape> square_grid(const std::vector<NamedPicture>& pictures) {
  uint64_t count = 0;
  for (const NamedPicture& picture : pictures) {
    count = std::max<uint64_t>(
        count, parse_camera_name(picture.file.stem().string()).value_or(0) + uint64_t{1});
  }
  uint32_t side = 1;
  while (side < kMaxGridSide && uint64_t{side} * side < count) ++side;
  if (uint64_t{side} * side != count) return std::nullopt;
  return GridShape{side, side};
}

}  // namespace hmlfc::io
