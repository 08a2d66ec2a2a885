#include "io/view_placement.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "io/natural_order.hpp"
#include "io/view_name.hpp"

namespace hmlfc::io {

namespace fs = std::filesystem;

namespace {

std::string describe_grid(GridShape grid) {
  return std::to_string(grid.rows) + "x" + std::to_string(grid.cols);
}

tl::unexpected<IoError> double_view(const fs::path& folder, uint64_t index, uint32_t cols,
                                    const fs::path& first, const fs::path& second) {
  return file_error(folder, "the view of " + describe_place(index, cols) + " is there twice, as " +
                                first.filename().string() + " and " + second.filename().string() +
                                "; remove one");
}

/// The last run of digits in a name, without its extension.
std::optional<uint64_t> last_number(const fs::path& file) {
  const std::string stem = file.stem().string();
  constexpr std::string_view kDigits = "0123456789";
  const size_t end = stem.find_last_of(kDigits);
  if (end == stem.npos) return std::nullopt;
  const size_t before = stem.find_last_not_of(kDigits, end);
  const size_t begin = before == stem.npos ? 0 : before + 1;
  if (end - begin >= 18) return std::nullopt;
  return std::stoull(stem.substr(begin, end - begin + 1));
}

/// ": the numbering jumps between A and B (row, column)" for the first jump, or "".
std::string describe_jump(const std::vector<fs::path>& files, uint32_t cols) {
  for (size_t i = 1; i < files.size(); ++i) {
    const auto before = last_number(files[i - 1]);
    const auto after = last_number(files[i]);
    if (before && after && *after > *before + 1) {
      return ": the numbering jumps between " + files[i - 1].filename().string() + " and " +
             files[i].filename().string() + " (" + describe_place(i, cols) + ")";
    }
  }
  return "";
}

}  // namespace

std::string describe_place(uint64_t index, uint32_t cols) {
  return "row " + std::to_string(index / cols) + ", column " + std::to_string(index % cols);
}

std::string name_some(const std::vector<std::string>& names) {
  constexpr size_t kNamed = 3;
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), kNamed); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  if (names.size() > kNamed) text += " and " + std::to_string(names.size() - kNamed) + " more";
  return text;
}

IoResult<ViewList> place_all(const fs::path& folder, GridShape grid,
                             std::vector<PlacedView> views) {
  std::ranges::stable_sort(views, {}, &PlacedView::index);
  const auto twin = std::ranges::adjacent_find(views, {}, &PlacedView::index);
  if (twin != views.end()) {
    return double_view(folder, twin->index, grid.cols, twin->file, std::next(twin)->file);
  }

  const uint64_t wanted = uint64_t{grid.rows} * grid.cols;
  if (views.size() < wanted) {
    std::vector<std::string> missing;
    auto next = views.begin();
    for (uint64_t index = 0; index < wanted && missing.size() < 3; ++index) {
      if (next != views.end() && next->index == index) {
        ++next;
      } else {
        missing.push_back(describe_place(index, grid.cols));
      }
    }
    const uint64_t total = wanted - views.size();
    return file_error(folder, std::to_string(total) + " of the " + std::to_string(wanted) +
                                  " views of a " + describe_grid(grid) + " grid " +
                                  (total == 1 ? "is" : "are") + " missing: " + name_some(missing) +
                                  (total > missing.size() ? " ..." : "") +
                                  " (rows and columns count from 0)");
  }
  ViewList list{grid.rows, grid.cols, {}};
  for (PlacedView& view : views) list.files.push_back(std::move(view.file));
  return list;
}

IoResult<ViewList> place_in_order(const fs::path& folder, GridShape grid,
                                  std::vector<fs::path> files) {
  for (size_t i = 1; i < files.size(); ++i) {
    if (natural_order(files[i - 1].stem().string(), files[i].stem().string()) == 0) {
      return double_view(folder, i - 1, grid.cols, files[i - 1], files[i]);
    }
  }
  const uint64_t wanted = uint64_t{grid.rows} * grid.cols;
  const std::string counts = std::to_string(files.size()) + " pictures for a " +
                             describe_grid(grid) + " grid of " + std::to_string(wanted) + " views";
  if (files.size() < wanted) {
    const std::string jump = describe_jump(files, grid.cols);
    const std::string end = ": after " + files.back().filename().string() + " the view of " +
                            describe_place(files.size(), grid.cols) + " is missing";
    return file_error(folder, counts + (jump.empty() ? end : jump));
  }
  if (files.size() > wanted) {
    return file_error(
        folder, counts + ": " + files[wanted].filename().string() + " is the first one too many");
  }
  return ViewList{grid.rows, grid.cols, std::move(files)};
}

}  // namespace hmlfc::io
