#include "io/view_list.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/files.hpp"
#include "io/hci_parameters.hpp"
#include "io/view_name.hpp"

namespace hmlfc::io {

namespace fs = std::filesystem;

namespace {

// A file at position `index` = row * columns + column.
struct PlacedView {
  uint64_t index = 0;
  fs::path file;
};

// "row 3, column 4".
std::string describe_place(uint64_t index, uint32_t cols) {
  return "row " + std::to_string(index / cols) + ", column " + std::to_string(index % cols);
}

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

// Up to three of `names`, then how many more there are: "a, b, c and 2 more".
std::string name_some(const std::vector<std::string>& names) {
  constexpr size_t kNamed = 3;
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), kNamed); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  if (names.size() > kNamed) text += " and " + std::to_string(names.size() - kNamed) + " more";
  return text;
}

// The list in which each index in [0, rows * cols - 1] has exactly one of `views`, given in any
// order, each with an index in that interval. Errors: a missing or duplicate index.
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

// The list of `files`, in natural order, row by row. Errors: two files with the same number, too
// few (with the first jump in the numbering, if there is one) or too many.
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

/// The folder's picture files in natural order.
IoResult<std::vector<fs::path>> find_pictures(const fs::path& folder) {
  std::error_code failure;
  if (!fs::is_directory(folder, failure)) {
    return file_error(folder, "not a folder; give the folder that holds the views");
  }
  std::vector<fs::path> files;
  for (fs::directory_iterator it(folder, failure), end; !failure && it != end;
       it.increment(failure)) {
    std::error_code ignored;
    if (is_picture_name(it->path()) && !it->is_directory(ignored)) files.push_back(it->path());
  }
  if (failure) return system_error(folder, "cannot list the folder", failure.value());
  if (files.empty()) return file_error(folder, "no PNG, JPEG, TIFF, WebP, PPM or PGM picture");
  std::ranges::sort(files, [](const fs::path& a, const fs::path& b) {
    const std::string left = a.stem().string();
    const std::string right = b.stem().string();
    const auto order = natural_order(left, right);
    return order != 0 ? order < 0 : a < b;
  });
  return files;
}

/// The image files classified by their names.
struct Classified {
  std::vector<PlacedView> views;        ///< the index still to be set from `positions`
  std::vector<GridPosition> positions;  ///< of each of `views`
  std::vector<std::string> strangers;   ///< names of another form
};

Classified by_grid_name(const std::vector<fs::path>& files) {
  Classified result;
  for (const fs::path& file : files) {
    if (const auto position = parse_grid_name(file.stem().string())) {
      result.views.push_back({0, file});
      result.positions.push_back(*position);
    } else {
      result.strangers.push_back(file.filename().string());
    }
  }
  return result;
}

Classified by_camera_name(const std::vector<fs::path>& files) {
  Classified result;
  for (const fs::path& file : files) {
    if (const auto index = parse_camera_name(file.stem().string())) {
      result.views.push_back({*index, file});
    } else {
      result.strangers.push_back(file.filename().string());
    }
  }
  return result;
}

tl::unexpected<IoError> extra_files(const fs::path& folder, const Classified& pictures,
                                    std::string_view form) {
  return file_error(folder, "extra picture " + name_some(pictures.strangers) +
                                " among views named " + std::string(form) + "; move it away");
}

tl::unexpected<IoError> outside(const fs::path& folder, const fs::path& file, uint64_t row,
                                uint64_t col, GridShape grid) {
  return file_error(folder, "extra view " + file.filename().string() + ": row " +
                                std::to_string(row) + ", column " + std::to_string(col) +
                                " is outside of the grid of " + std::to_string(grid.rows) +
                                " rows and " + std::to_string(grid.cols) +
                                " columns that was asked for (both count from 0)");
}

// Numbers rows and columns anew, from 0 and without gaps, where that gives a grid of the size asked
// for: the views are a subset, such as every second column, of a larger grid.
void take_subset(GridShape asked, std::vector<GridPosition>& positions) {
  std::set<uint32_t> rows;
  std::set<uint32_t> cols;
  for (const GridPosition& position : positions) {
    rows.insert(position.row);
    cols.insert(position.col);
  }
  if (rows.size() != asked.rows || cols.size() != asked.cols) return;
  const auto number = [](const std::set<uint32_t>& used, uint32_t value) {
    return static_cast<uint32_t>(std::distance(used.begin(), used.find(value)));
  };
  for (GridPosition& position : positions) {
    position = {number(rows, position.row), number(cols, position.col)};
  }
}

IoResult<ViewList> list_by_grid_name(const fs::path& folder, std::optional<GridShape> asked,
                                     Classified pictures) {
  if (!pictures.strangers.empty()) return extra_files(folder, pictures, "by row and column");
  GridShape grid;
  for (const GridPosition& position : pictures.positions) {
    grid.rows = std::max(grid.rows, position.row + 1);
    grid.cols = std::max(grid.cols, position.col + 1);
  }
  if (asked) {
    take_subset(*asked, pictures.positions);
    grid = *asked;
  }
  for (size_t i = 0; i < pictures.views.size(); ++i) {
    const GridPosition position = pictures.positions[i];
    if (position.row >= grid.rows || position.col >= grid.cols) {
      return outside(folder, pictures.views[i].file, position.row, position.col, grid);
    }
    pictures.views[i].index = uint64_t{position.row} * grid.cols + position.col;
  }
  return place_all(folder, grid, std::move(pictures.views));
}

/// The side of the square grid of `count` views, or nothing.
std::optional<uint32_t> square_side(uint64_t count) {
  for (uint64_t side = 1; side <= kMaxGridSide && side * side <= count; ++side) {
    if (side * side == count) return static_cast<uint32_t>(side);
  }
  return std::nullopt;
}

IoResult<ViewList> list_by_camera_name(const fs::path& folder, std::optional<GridShape> asked,
                                       Classified pictures) {
  if (!pictures.strangers.empty()) return extra_files(folder, pictures, "input_CamNNN");
  if (!asked) {
    const uint64_t count = std::ranges::max(pictures.views, {}, &PlacedView::index).index + 1;
    const auto side = square_side(count);
    if (!side) {
      return file_error(folder, "views are numbered up to input_Cam" + std::to_string(count - 1) +
                                    ", which is no square grid; give --grid ROWSxCOLS");
    }
    asked = GridShape{*side, *side};
  }
  const uint64_t wanted = uint64_t{asked->rows} * asked->cols;
  const auto beyond = [&](const PlacedView& view) { return view.index >= wanted; };
  if (pictures.views.size() == wanted && std::ranges::any_of(pictures.views, beyond)) {
    std::ranges::stable_sort(pictures.views, {}, &PlacedView::index);
    std::vector<fs::path> files;
    for (PlacedView& view : pictures.views) files.push_back(std::move(view.file));
    return place_in_order(folder, *asked, std::move(files));
  }
  for (const PlacedView& view : pictures.views) {
    const uint64_t row = view.index / asked->cols;
    if (row >= asked->rows) {
      return outside(folder, view.file, row, view.index % asked->cols, *asked);
    }
  }
  return place_all(folder, *asked, std::move(pictures.views));
}

}  // namespace

bool is_picture_name(const fs::path& file) {
  constexpr std::array<std::string_view, 11> kExtensions = {
      ".png", ".ppm", ".pgm", ".pnm", ".jpg", ".jpeg", ".jpe", ".jfif", ".tif", ".tiff", ".webp"};
  return !file.filename().string().starts_with('.') &&
         std::ranges::find(kExtensions, lower_case_extension(file)) != kExtensions.end();
}

IoResult<ViewList> list_views(const fs::path& folder, std::optional<GridShape> grid) {
  if (grid && (grid->rows < 1 || grid->cols < 1 || grid->rows > kMaxGridSide ||
               grid->cols > kMaxGridSide)) {
    return file_error(folder, "a grid must have 1 to 4096 rows and 1 to 4096 columns");
  }
  auto files = find_pictures(folder);
  if (!files) return tl::unexpected(files.error());

  Classified grid_names = by_grid_name(*files);
  Classified camera_names = by_camera_name(*files);
  const size_t others = files->size() - grid_names.views.size() - camera_names.views.size();
  if (grid_names.views.size() >= std::max(camera_names.views.size(), others)) {
    return list_by_grid_name(folder, grid, std::move(grid_names));
  }
  if (camera_names.views.size() >= others) {
    return list_by_camera_name(folder, grid ? grid : hci_grid(folder), std::move(camera_names));
  }
  if (!grid) {
    return file_error(folder, "the names of the pictures (" + files->front().filename().string() +
                                  " ...) do not say row and column; give --grid ROWSxCOLS");
  }
  return place_in_order(folder, *grid, std::move(*files));
}

}  // namespace hmlfc::io
