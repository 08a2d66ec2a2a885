#include "io/view_reading.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "io/hci_parameters.hpp"
#include "io/name_grid.hpp"
#include "io/view_list_text.hpp"
#include "io/view_name.hpp"

namespace hmlfc::io {

namespace fs = std::filesystem;

namespace {

// The number that is another one in each picture.
std::optional<NumberColumn> counter_of(const std::vector<NamedPicture>& pictures) {
  for (NumberColumn& column : number_columns(pictures)) {
    if (column.values.size() == pictures.size()) return std::move(column);
  }
  return std::nullopt;
}

// The square grid of pictures input_CamNNN, which count from 0, or nothing.
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

// Pictures whose names have one form or match a pattern, and the names of all others.
struct Views {
  std::vector<NamedPicture> pictures;
  std::vector<std::string> strangers;
  std::string rival;  // a picture of another form of which there are as many
};

// Finds out how the pictures of a folder are views; they come in the sorted order of their names.
class Reading {
 public:
  Reading(const fs::path& folder, const ViewNaming& naming, std::vector<NamedPicture> pictures)
      : folder_(folder), naming_(naming), all_{std::move(pictures), {}, {}} {}

  IoResult<ViewList> list() {
    if (all_.pictures.empty()) {
      return file_error(folder_, "no PNG, JPEG, TIFF, WebP, PPM or PGM picture");
    }
    const auto pattern = NamePattern::parse(naming_.pattern);
    if (!pattern) return refuse("--names '" + naming_.pattern + "': " + pattern.error());
    if (!naming_.pattern.empty() && !keep_matches(*pattern)) {
      return refuse("no name is as --names '" + naming_.pattern + "' says; one is " +
                    shown_name(all_.pictures.front()));
    }
    if (by_pattern_ && pattern->has_position()) {
      if (!naming_.order) return by_position();
      return refuse("--names says row and column, and --order is for a sequence; leave one out");
    }
    if (by_pattern_ && pattern->has_index()) return in_sequence(std::move(all_), naming_.grid);
    for (const bool decimals : {true, false}) {
      if (naming_.order) break;
      if (auto found = by_numbers(decimals)) return *found;
    }
    return in_order();
  }

 private:
  tl::unexpected<IoError> refuse(const std::string& what) const {
    return file_error(folder_, what);
  }

  // Leaves pictures whose names match, with the numbers at the fields; false where there are none.
  bool keep_matches(const NamePattern& pattern) {
    const bool with_extension = is_picture_name("x" + naming_.pattern);
    Views matches;
    for (const bool whole : {true, false}) {
      matches = {};
      for (const NamedPicture& picture : all_.pictures) {
        auto numbers = pattern.match(with_extension ? shown_name(picture) : picture.name, whole);
        if (numbers) {
          matches.pictures.push_back({picture.file, picture.name, std::move(*numbers)});
        } else {
          matches.strangers.push_back(shown_name(picture));
        }
      }
      if (!matches.pictures.empty()) break;
    }
    by_pattern_ = !matches.pictures.empty();
    if (by_pattern_) all_ = std::move(matches);
    return by_pattern_ || naming_.pattern_is_for_others;
  }

  // The pictures of the form that most names have.
  Views of_one_form(bool decimals) const {
    std::map<std::string, std::vector<NamedPicture>> forms;
    for (const NamedPicture& picture : all_.pictures) {
      auto numbers = numbers_of(picture.name, decimals);
      auto& form = forms[form_of(picture.name, numbers)];
      form.push_back({picture.file, picture.name, std::move(numbers)});
    }
    Views views{{}, all_.strangers, {}};
    for (auto& [form, pictures] : forms) {
      if (pictures.size() > views.pictures.size()) {
        std::swap(views.pictures, pictures);
        views.rival.clear();
      } else if (pictures.size() == views.pictures.size()) {
        views.rival = shown_name(pictures.front());
      }
      for (const NamedPicture& other : pictures) views.strangers.push_back(shown_name(other));
    }
    return views;
  }

  ViewList empty_list(const Views& views, GridShape grid, const std::string& understood) const {
    ViewList list{grid.rows, grid.cols, std::vector<fs::path>(views.pictures.size()), folder_, {}};
    if (!understood.empty()) list.notes.push_back(understood);
    if (!views.strangers.empty()) {
      list.notes.push_back(fmt::format("ignored, for not being named like the {} views ({}): {}",
                                       views.pictures.size(), shown_name(views.pictures.front()),
                                       name_some(views.strangers)));
    }
    for (std::string& note : list.notes) note = folder_.string() + ": " + note;
    return list;
  }

  ViewList placed(const Views& views, const GridReading& reading,
                  const std::string& understood) const {
    ViewList list = empty_list(
        views, {static_cast<uint32_t>(reading.rows()), static_cast<uint32_t>(reading.cols())},
        understood);
    for (size_t i = 0; i < views.pictures.size(); ++i) {
      list.files[reading.place(i)] = views.pictures[i].file;
    }
    return list;
  }

  // Rows and columns as the pattern says.
  IoResult<ViewList> by_position() const {
    const auto columns = position_columns(all_.pictures);
    const GridReading reading{&columns[0], &columns[1]};
    if (is_full(reading, all_.pictures.size(), naming_.grid)) return placed(all_, reading, "");
    std::map<size_t, const NamedPicture*> places;
    for (size_t i = 0; i < all_.pictures.size(); ++i) {
      const auto [there, is_new] = places.emplace(reading.place(i), &all_.pictures[i]);
      if (is_new) continue;
      return refuse("--names '" + naming_.pattern + "' reads the same row and column in " +
                    shown_name(*there->second) + " and " + shown_name(all_.pictures[i]) +
                    "; the two are {row} and {col}, and one that is left out is 0");
    }
    return missing(all_, reading);
  }

  // Two numbers of the names are row and column; nothing where no two make a full grid.
  std::optional<IoResult<ViewList>> by_numbers(bool decimals) const {
    const Views views = of_one_form(decimals);
    if (!views.rival.empty()) return std::nullopt;
    const auto columns = number_columns(views.pictures);
    const auto readings = full_grids(views.pictures, columns, naming_.grid);
    if (readings.empty()) return std::nullopt;
    if (readings.size() > 1) return refuse(describe_choice(views.pictures, readings));
    return placed(views, readings.front(), describe_reading(views.pictures, readings.front()));
  }

  IoResult<ViewList> twice(const NamedPicture& a, const NamedPicture& b) const {
    return refuse("the same view is there twice, as " + shown_name(a) + " and " + shown_name(b) +
                  "; remove one of them, or choose by --names, such as --names '*.png'");
  }

  IoResult<ViewList> missing(const Views& views, const GridReading& reading) const {
    const bool shaped = naming_.grid && reading.rows() == naming_.grid->rows &&
                        reading.cols() == naming_.grid->cols;
    std::string text = describe_missing(views.pictures, reading, shaped, by_pattern_);
    if (naming_.grid && !shaped) text += "; --grid says " + describe(*naming_.grid);
    return refuse(text + others(views));
  }

  static std::string others(const Views& views) {
    return views.strangers.empty() ? "" : "; not named so: " + name_some(views.strangers);
  }

  // Says what is wrong with names that have row and column; nothing where they may have none.
  std::optional<IoResult<ViewList>> wrong_grid(const Views& views) const {
    const auto columns = number_columns(views.pictures);
    if (const auto near = nearest_grid(views.pictures, columns, naming_.grid)) {
      return missing(views, *near);
    }
    if (!naming_.grid) return std::nullopt;
    for (const GridReading& other : full_grids(views.pictures, columns, std::nullopt)) {
      if (other.rows() == 1 || other.cols() == 1) continue;
      return refuse(fmt::format(
          "the names have row and column (numbers {} and {}) of a grid of {}x{} views, not {}; "
          "--order raster takes them in sorted order instead",
          other.row->number + 1, other.col->number + 1, other.rows(), other.cols(),
          describe(*naming_.grid)));
    }
    const auto near = nearest_grid(views.pictures, columns, std::nullopt);
    if (near) return missing(views, *near);
    return std::nullopt;
  }

  // The names are those of a sequence, or what is wrong with them is said.
  IoResult<ViewList> in_order() const {
    Views views = of_one_form(true);
    const auto& pictures = views.pictures;
    const bool all_wanted =
        naming_.grid && all_.pictures.size() == size_t{naming_.grid->rows} * naming_.grid->cols;
    if (pictures.size() == 1 || 4 * pictures.size() < all_.pictures.size()) {
      return in_sequence(all_, naming_.grid);  // hardly any two names are alike
    }
    if (!views.rival.empty() && !all_wanted) {
      return refuse(fmt::format(
          "pictures are named like {} and, as many, like {}; choose by --names, such as --names {}",
          shown_name(pictures.front()), views.rival, open_pattern(pictures.front())));
    }
    for (size_t i = 1; i < pictures.size(); ++i) {
      if (natural_order(pictures[i - 1].name, pictures[i].name) == 0) {
        return twice(pictures[i - 1], pictures[i]);
      }
    }
    if (!naming_.order) {
      if (const auto wrong = wrong_grid(views)) return *wrong;
    }
    if (all_wanted && pictures.size() < all_.pictures.size()) views = all_;
    return in_sequence(views, naming_.grid);
  }

  // As the numbers of the names count, or as the names are sorted.
  IoResult<ViewList> in_sequence(const Views& views, std::optional<GridShape> grid) const {
    const bool is_hci = parse_camera_name(views.pictures.front().file.stem().string()).has_value();
    const auto stated = hci_grid(folder_);
    if (!grid && stated) grid = *stated;
    if (!naming_.grid && !is_hci && grid &&
        views.pictures.size() != size_t{grid->rows} * grid->cols) {
      grid.reset();
    }
    if (!grid && is_hci) grid = square_grid(views.pictures);
    if (!grid && !stated)
      return tl::unexpected(IoError{stated.error().message +
                                    ", so that it does not tell the grid; mend it or give --grid"});
    if (!grid) {
      const auto columns = number_columns(views.pictures);
      const auto full = full_grids(views.pictures, columns, std::nullopt);
      return refuse(naming_.order && !full.empty()
                        ? fmt::format("the names have row and column of {0}x{1} views, and --order "
                                      "is for a sequence; leave it out, or give --grid {0}x{1} for "
                                      "their sorted order",
                                      full.front().rows(), full.front().cols())
                        : describe_no_grid(views.pictures, columns) + others(views));
    }
    const auto order = naming_.order.value_or(FrameOrder::kRaster);
    const auto counter = counter_of(views.pictures);
    if (views.pictures.size() != size_t{grid->rows} * grid->cols) {
      return refuse(describe_count(views.pictures, counter, *grid, order, is_hci) + others(views));
    }
    ViewList list = empty_list(
        views, *grid,
        is_hci && stated && *stated ? "" : describe_order(views.pictures, counter, *grid, order));
    if (!naming_.grid && !stated) {
      list.notes.push_back(stated.error().message + "; a square grid is taken");
    }
    for (size_t i = 0; i < views.pictures.size(); ++i) {
      const GridPosition at = view_of_frame(counter ? counter->ranks[i] : i, *grid, order);
      list.files[size_t{at.row} * grid->cols + at.col] = views.pictures[i].file;
    }
    return list;
  }

  const fs::path& folder_;
  const ViewNaming& naming_;
  Views all_;
  bool by_pattern_ = false;
};

}  // namespace

IoResult<ViewList> read_names(const fs::path& folder, const ViewNaming& naming,
                              std::vector<NamedPicture> pictures) {
  std::ranges::sort(pictures, [](const NamedPicture& a, const NamedPicture& b) {
    const auto order = natural_order(a.name, b.name);
    return order != 0 ? order < 0 : a.file < b.file;
  });
  return Reading(folder, naming, std::move(pictures)).list();
}

}  // namespace hmlfc::io
