#include "io/transforms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/view_list.hpp"

namespace hmlfc::io {
namespace {

using Json = nlohmann::json;
using Matrix = std::array<std::array<double, 4>, 3>;  // rotation and, in column 3, position
using Quaternion = std::array<double, 4>;

template <class T>
using Read = tl::expected<T, std::string>;

tl::unexpected<std::string> wrong(std::string what) { return tl::unexpected(std::move(what)); }

// One frame, with what the file says for all frames behind it.
struct Frame {
  const Json& file;
  const Json& frame;
  std::string place;  // "frames[3]"

  // The number `member`; its own before the file's.
  Read<std::optional<double>> number(const char* member) const {
    const bool own = frame.contains(member);
    if (!own && !file.contains(member)) return std::nullopt;
    const Json& json = own ? frame[member] : file[member];
    if (json.is_number() && std::isfinite(json.get<double>())) return json.get<double>();
    return wrong(fmt::format("{}{} must be a number", own ? place + "." : "", member));
  }
};

Read<Matrix> matrix_of(const Frame& frame) {
  const std::string place = frame.place + ".transform_matrix";
  const auto rows = frame.frame.find("transform_matrix");
  const bool right_size =
      rows != frame.frame.end() && rows->is_array() && (rows->size() == 3 || rows->size() == 4);
  if (!right_size) return wrong(place + " must be 3 or 4 rows of 4 numbers");
  Matrix matrix{};
  for (size_t r = 0; r < rows->size(); ++r) {
    const Json& row = (*rows)[r];
    const bool numbers = row.is_array() && row.size() == 4 &&
                         std::ranges::all_of(row, [](const Json& x) { return x.is_number(); });
    if (!numbers) return wrong(fmt::format("{}[{}] must be 4 numbers", place, r));
    for (size_t c = 0; c < 4 && r < 3; ++c) matrix[r][c] = row[c].get<double>();
    if (r == 3 && row != Json({0.0, 0.0, 0.0, 1.0})) {
      return wrong(fmt::format("{}[3] must be 0, 0, 0, 1", place));
    }
  }
  return matrix;
}

double determinant(const Matrix& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// Columns of length 1, at right angles, right-handed, each to within 1/1000.
bool is_rotation(const Matrix& m) {
  constexpr double kSlack = 1e-3;
  for (size_t a = 0; a < 3; ++a) {
    for (size_t b = a; b < 3; ++b) {
      const double dot = m[0][a] * m[0][b] + m[1][a] * m[1][b] + m[2][a] * m[2][b];
      if (!(std::abs(dot - (a == b ? 1 : 0)) <= kSlack)) return false;
    }
  }
  return determinant(m) > 0;
}

// The quaternion of a rotation, of length 1 and with w >= 0, from its greatest component on (after
// Shepperd), so that no small number divides.
Quaternion quaternion_of(const Matrix& m) {
  const double trace = m[0][0] + m[1][1] + m[2][2];
  const std::array<double, 4> squares{1 + trace, 1 + 2 * m[0][0] - trace, 1 + 2 * m[1][1] - trace,
                                      1 + 2 * m[2][2] - trace};  // four times those of w, x, y, z
  const auto greatest = static_cast<size_t>(std::ranges::max_element(squares) - squares.begin());
  const double x = m[2][1] - m[1][2];
  const double y = m[0][2] - m[2][0];
  const double z = m[1][0] - m[0][1];
  const double xy = m[0][1] + m[1][0];
  const double xz = m[0][2] + m[2][0];
  const double yz = m[1][2] + m[2][1];
  const std::array<Quaternion, 4> scaled{Quaternion{squares[0], x, y, z},
                                         {x, squares[1], xy, xz},
                                         {y, xy, squares[2], yz},
                                         {z, xz, yz, squares[3]}};
  Quaternion q = scaled[greatest];
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const double divisor = q[0] < 0 ? -length : length;
  for (double& part : q) part /= divisor;
  return q;
}

// Nothing where the file knows no focal length.
Read<std::optional<Quaternion>> intrinsics_of(const Frame& frame, const CameraPictures& pictures) {
  std::map<std::string, std::optional<double>> given;
  for (const char* member : {"fl_x", "fl_y", "cx", "cy", "w", "h", "camera_angle_x",
                             "camera_angle_y", "k1", "k2", "k3", "k4", "p1", "p2"}) {
    const auto value = frame.number(member);
    if (!value) return tl::unexpected(value.error());
    given[member] = *value;
  }
  for (const char* member : {"k1", "k2", "k3", "k4", "p1", "p2"}) {
    if (given[member].value_or(0) != 0) {
      return wrong(
          fmt::format("{} is {}: a rig has no distortion; undistort the pictures and set "
                      "it to 0",
                      member, *given[member]));
    }
  }
  const double w = given["w"].value_or(pictures.width);
  const double h = given["h"].value_or(pictures.height);
  if (w < 1 || h < 1) return wrong("w and h must be at least 1");
  const auto focal = [](std::optional<double> length, std::optional<double> angle, double side) {
    if (length || !angle) return length;
    return std::optional(side / 2 / std::tan(*angle / 2));
  };
  const auto fl_x = focal(given["fl_x"], given["camera_angle_x"], w);
  if (!fl_x) return std::nullopt;
  const double fl_y = focal(given["fl_y"], given["camera_angle_y"], h).value_or(*fl_x);
  const double to_x = pictures.width / w;
  const double to_y = pictures.height / h;
  return Quaternion{*fl_x * to_x, fl_y * to_y, given["cx"].value_or(w / 2) * to_x - 0.5,
                    given["cy"].value_or(h / 2) * to_y - 0.5};
}

// The file name in `path` without the extension of a picture.
std::string picture_stem(const std::string& path) {
  const std::filesystem::path name = std::filesystem::path(path).filename();
  return (is_picture_name(name) ? name.stem() : name).string();
}

// For each picture the number of its frame.
Read<std::vector<size_t>> frames_of(const Json& frames, const CameraPictures& pictures) {
  std::map<std::string, size_t> by_stem;
  for (size_t i = 0; i < frames.size(); ++i) {
    const bool named = frames[i].is_object() && frames[i].contains("file_path") &&
                       frames[i]["file_path"].is_string();
    if (!named) return wrong(fmt::format("frames[{}].file_path must be a text", i));
    const auto stem = picture_stem(frames[i]["file_path"].get<std::string>());
    const auto [first, is_new] = by_stem.emplace(stem, i);
    if (!is_new && std::ranges::find(pictures.stems, stem) != pictures.stems.end()) {
      return wrong(fmt::format("frames[{}] and frames[{}] both name {}", first->second, i, stem));
    }
  }
  std::vector<size_t> numbers;
  for (const std::string& stem : pictures.stems) {
    const auto found = by_stem.find(stem);
    if (found == by_stem.end()) {
      return wrong(fmt::format("frames: no file_path names the view {}", stem));
    }
    numbers.push_back(found->second);
  }
  return numbers;
}

// One entry in place of many that are equal.
template <class T>
void keep_one_of_equals(std::vector<T>& entries) {
  if (std::ranges::adjacent_find(entries, std::ranges::not_equal_to()) == entries.end() &&
      !entries.empty()) {
    entries.resize(1);
  }
}

// Looks for the member "frames" of the outermost object.
class FrameFinder final : public JsonHandler {
 public:
  bool found = false;

  bool null() override { return true; }
  bool boolean(bool /*value*/) override { return true; }
  bool number_integer(number_integer_t /*value*/) override { return true; }
  bool number_unsigned(number_unsigned_t /*value*/) override { return true; }
  bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return true; }
  bool string(string_t& /*value*/) override { return true; }
  bool start_object(size_t /*count*/) override { return ++depth_ > 0; }
  bool end_object() override { return --depth_ >= 0; }
  bool start_array(size_t /*count*/) override { return ++depth_ > 0; }
  bool end_array() override { return --depth_ >= 0; }
  bool key(string_t& name) override {
    found = depth_ == 1 && name == "frames";
    return !found;
  }

 private:
  int depth_ = 0;
};

}  // namespace

bool is_transforms(std::span<const uint8_t> text) {
  FrameFinder finder;
  static_cast<void>(walk_json(text, kTransformsLimits, finder));
  return finder.found;
}

tl::expected<Rig, std::string> rig_of_transforms(const Json& json, const CameraPictures& pictures) {
  const Json& frames = json.at("frames");
  if (!frames.is_array()) return wrong("frames must be an array");
  if (json.value("is_fisheye", Json(false)) == Json(true)) {
    return wrong("is_fisheye is true: a rig has no distortion; undistort the pictures");
  }
  const auto numbers = frames_of(frames, pictures);
  if (!numbers) return tl::unexpected(numbers.error());
  Rig rig;
  for (const size_t number : *numbers) {
    const Frame frame{json, frames[number], fmt::format("frames[{}]", number)};
    auto matrix = matrix_of(frame);
    if (!matrix) return tl::unexpected(matrix.error());
    if (!is_rotation(*matrix)) {
      return wrong(frame.place + ".transform_matrix does not turn: its columns must have the " +
                   "length 1 and be at right angles, without a mirror");
    }
    rig.positions.push_back({(*matrix)[0][3], (*matrix)[1][3], (*matrix)[2][3]});
    // Y up and Z backwards become Y down and Z into the scene.
    for (auto& row : *matrix) row = {row[0], -row[1], -row[2], row[3]};
    rig.rotations.push_back(quaternion_of(*matrix));
    const auto intrinsics = intrinsics_of(frame, pictures);
    if (!intrinsics) return tl::unexpected(intrinsics.error());
    if (*intrinsics) rig.intrinsics.push_back(**intrinsics);
  }
  if (rig.intrinsics.size() != rig.positions.size()) rig.intrinsics.clear();
  keep_one_of_equals(rig.rotations);
  keep_one_of_equals(rig.intrinsics);
  return rig;
}

}  // namespace hmlfc::io
