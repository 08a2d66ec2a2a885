#include "io/view_list.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

#include "io/natural_order.hpp"
#include "io/view_name.hpp"
#include "io/view_placement.hpp"

namespace hmlfc::io {

namespace fs = std::filesystem;

namespace {

bool is_picture_name(const fs::path& file) {
  constexpr std::array<std::string_view, 6> kExtensions = {".png", ".ppm", ".pgm",
                                                           ".pnm", ".jpg", ".jpeg"};
  std::string extension = file.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return file.filename().string().front() != '.' &&
         std::ranges::find(kExtensions, extension) != kExtensions.end();
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
  if (files.empty()) return file_error(folder, "no PNG, PPM, PGM or JPEG picture in this folder");
  std::ranges::sort(files, [](const fs::path& a, const fs::path& b) {
    const std::string left = a.stem().string();
    const std::string right = b.stem().string();
    const auto order = natural_order(left, right);
    return order != 0 ? order < 0 : a < b;
  });
  return files;
}

/// The pictures sorted by what their names say.
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

IoResult<ViewList> list_by_grid_name(const fs::path& folder, std::optional<GridShape> asked,
                                     Classified pictures) {
  if (!pictures.strangers.empty()) return extra_files(folder, pictures, "by row and column");
  GridShape grid;
  for (const GridPosition& position : pictures.positions) {
    grid.rows = std::max(grid.rows, position.row + 1);
    grid.cols = std::max(grid.cols, position.col + 1);
  }
  if (asked) grid = *asked;
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
  for (const PlacedView& view : pictures.views) {
    const uint64_t row = view.index / asked->cols;
    if (row >= asked->rows) {
      return outside(folder, view.file, row, view.index % asked->cols, *asked);
    }
  }
  return place_all(folder, *asked, std::move(pictures.views));
}

}  // namespace

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
    return list_by_camera_name(folder, grid, std::move(camera_names));
  }
  if (!grid) {
    return file_error(folder, "the names of the pictures (" + files->front().filename().string() +
                                  " ...) do not say row and column; give --grid ROWSxCOLS");
  }
  return place_in_order(folder, *grid, std::move(*files));
}

}  // namespace hmlfc::io
