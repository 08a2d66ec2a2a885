#include "io/hci_parameters.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "io/files.hpp"
#include "io/view_name.hpp"

namespace hmlfc::io {
namespace {

using Members = std::map<std::string, std::string, std::less<>>;  // "section.key" to its value

tl::unexpected<std::string> no_rig(std::string what) { return tl::unexpected(std::move(what)); }

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpaces = " \t\r";
  const size_t begin = text.find_first_not_of(kSpaces);
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpaces) - begin + 1);
}

// As Python's configparser reads it: [SECTION], KEY = VALUE or KEY: VALUE; # and ; begin comments;
// a line that begins with a space goes on with the value before.
tl::expected<Members, std::string> read_members(std::string_view text) {
  Members members;
  std::string section;
  for (int number = 1; !text.empty(); ++number) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string_view whole = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string_view line = trimmed(whole);
    if (line.empty() || line.front() == '#' || line.front() == ';') continue;
    if (whole.front() == ' ' || whole.front() == '\t') continue;
    if (line.front() == '[' && line.back() == ']') {
      section = line.substr(1, line.size() - 2);
      continue;
    }
    const size_t sign = line.find_first_of("=:");
    if (sign == line.npos || section.empty()) {
      return no_rig(fmt::format("line {} is no [SECTION] and, in one, no KEY = VALUE", number));
    }
    const std::string name = fmt::format("{}.{}", section, trimmed(line.substr(0, sign)));
    if (!members.emplace(name, trimmed(line.substr(sign + 1))).second) {
      return no_rig(fmt::format("line {}: {} is there twice", number, name));
    }
  }
  return members;
}

// Reads members until one is wrong.
class Reader {
 public:
  explicit Reader(const Members& members) : members_(members) {}

  // A number in [least, most].
  double number(const char* name, double least, double most) {
    const auto found = members_.find(name);
    if (found == members_.end()) return fail(fmt::format("{} is missing", name));
    const std::string& text = found->second;
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
      return fail(fmt::format("{} is \"{}\"; it must be a number", name, text));
    }
    if (!(value >= least && value <= most)) {
      return fail(fmt::format("{} is {}; it must lie in [{}, {}]", name, text, least, most));
    }
    return value;
  }

  uint32_t integer(const char* name, uint32_t most) {
    const double value = number(name, 1, most);
    if (value != std::floor(value)) fail(fmt::format("{} must be an integer", name));
    return static_cast<uint32_t>(value);
  }

  GridShape grid() {
    const uint32_t cols = integer("extrinsics.num_cams_x", kMaxGridSide);
    return {integer("extrinsics.num_cams_y", kMaxGridSide), cols};
  }

  const std::optional<std::string>& failure() const { return failure_; }

 private:
  double fail(std::string what) {
    if (!failure_) failure_ = std::move(what);
    return 1;
  }

  const Members& members_;
  std::optional<std::string> failure_;
};

// Without a byte order mark.
std::string_view text_of(const MappedFile& file) {
  const std::string_view text(reinterpret_cast<const char*>(file.bytes().data()),
                              file.bytes().size());
  return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

double middle(uint32_t count) { return (static_cast<double>(count) - 1) / 2; }

// Pixels of a view that is `from` wide or high, of a picture that has `to`.
double scale(uint32_t from, uint32_t to) { return static_cast<double>(to) / from; }

// The place in the file's grid of each view.
tl::expected<std::vector<GridPosition>, std::string> places_of(const GridShape& grid,
                                                               const ViewList& views) {
  std::vector<GridPosition> places;
  for (const auto& file : views.files) {
    const auto number = parse_camera_name(file.stem().string());
    if (!number) break;
    const GridPosition place{*number / grid.cols, *number % grid.cols};
    if (place.row >= grid.rows) {
      return no_rig(fmt::format("it has {} x {} cameras, and none of the view {}", grid.rows,
                                grid.cols, file.filename().string()));
    }
    places.push_back(place);
  }
  if (places.size() == views.files.size()) {
    for (size_t i = 0; i < places.size(); ++i) {
      if (places[i].row == places[i / views.cols * views.cols].row &&
          places[i].col == places[i % views.cols].col) {
        continue;
      }
      return no_rig(fmt::format("of its {} x {} cameras those of the {} x {} views form no grid",
                                grid.rows, grid.cols, views.rows, views.cols));
    }
    return places;
  }
  if (views.rows != grid.rows || views.cols != grid.cols) {
    return no_rig(fmt::format("it has {} x {} cameras, but there are {} x {} views", grid.rows,
                              grid.cols, views.rows, views.cols));
  }
  places.clear();
  for (uint32_t i = 0; i < grid.rows * grid.cols; ++i) {
    places.push_back({i / grid.cols, i % grid.cols});
  }
  return places;
}

}  // namespace

tl::expected<HciParameters, std::string> parse_hci_parameters(std::string_view text) {
  constexpr double kLeast = 1e-6;
  constexpr double kMost = 1e6;
  const auto members = read_members(text);
  if (!members) return tl::unexpected(members.error());
  Reader reader(*members);
  HciParameters read;
  read.focal_length_mm = reader.number("intrinsics.focal_length_mm", kLeast, kMost);
  read.width = reader.integer("intrinsics.image_resolution_x_px", 65536);
  read.height = reader.integer("intrinsics.image_resolution_y_px", 65536);
  read.sensor_size_mm = reader.number("intrinsics.sensor_size_mm", kLeast, kMost);
  read.grid = reader.grid();
  read.baseline_mm = reader.number("extrinsics.baseline_mm", kLeast, kMost);
  read.focus_distance_m = reader.number("extrinsics.focus_distance_m", 0, kMost);
  if (reader.failure()) return no_rig(*reader.failure());
  return read;
}

IoResult<HciParameters> read_hci_parameters(const std::filesystem::path& file) {
  const auto mapped = map_file(file);
  if (!mapped) return tl::unexpected(mapped.error());
  const auto read = parse_hci_parameters(text_of(*mapped));
  if (!read) return file_error(file, read.error());
  return *read;
}

IoResult<std::optional<GridShape>> hci_grid(const std::filesystem::path& folder) {
  const auto file = file_named(folder, kHciParametersName);
  if (file.empty()) return std::nullopt;
  const auto mapped = map_file(file);
  if (!mapped) return tl::unexpected(mapped.error());
  const auto members = read_members(text_of(*mapped));
  if (!members) return file_error(file, members.error());
  Reader reader(*members);
  const GridShape grid = reader.grid();
  if (reader.failure()) return file_error(file, *reader.failure());
  return grid;
}

tl::expected<Rig, std::string> rig_of_hci(const HciParameters& parameters, const ViewList& views,
                                          const LightFieldShape& shape) {
  const auto places = places_of(parameters.grid, views);
  if (!places) return tl::unexpected(places.error());
  const double width = parameters.width;
  const double height = parameters.height;
  // Sides of smaller copies are whole numbers: each is less than a pixel off.
  if (std::abs(width * shape.height - height * shape.width) > std::max(width, height)) {
    return no_rig(fmt::format("image_resolution is {} x {}, the views {} x {}: another aspect",
                              parameters.width, parameters.height, shape.width, shape.height));
  }
  const double focal = parameters.focal_length_mm / parameters.sensor_size_mm *
                       std::max(parameters.width, parameters.height);
  const double step = parameters.baseline_mm / 1000;
  const double distance = parameters.focus_distance_m;
  const double shift = distance > 0 ? focal * step / distance : 0;
  const double to_x = scale(parameters.width, shape.width);
  const double to_y = scale(parameters.height, shape.height);
  Rig rig;
  rig.metres_per_unit = 1;
  for (const GridPosition& place : *places) {
    const double right = place.col - middle(parameters.grid.cols);
    const double down = place.row - middle(parameters.grid.rows);
    rig.positions.push_back({right * step, down * step, 0});
    rig.intrinsics.push_back({focal * to_x, focal * to_y,
                              middle(shape.width) + right * shift * to_x,
                              middle(shape.height) + down * shift * to_y});
  }
  if (shift == 0) rig.intrinsics.resize(1);
  return rig;
}

}  // namespace hmlfc::io
