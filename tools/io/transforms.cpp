#include "io/transforms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/transforms_lens.hpp"
#include "io/view_list.hpp"

namespace hmlfc::io {
namespace {

using Json = nlohmann::json;
using Matrix = std::array<std::array<double, 4>, 3>;  // rotation and, in column 3, position
using Quaternion = std::array<double, 4>;

template <class T>
using Read = tl::expected<T, std::string>;

tl::unexpected<std::string> wrong(std::string what) { return tl::unexpected(std::move(what)); }

// Numbers of float32 are as good as others: 0.99999994 is 1.
constexpr double kMatrixSlack = 1e-3;

Read<Matrix> matrix_of(const TransformsFrame& frame) {
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
    for (size_t c = 0; c < 4; ++c) {
      const auto number = row[c].get<double>();
      if (r < 3) {
        matrix[r][c] = number;
      } else if (!(std::abs(number - (c == 3 ? 1 : 0)) <= kMatrixSlack)) {
        return wrong(fmt::format("{}[3] must be 0, 0, 0, 1", place));
      }
    }
  }
  return matrix;
}

double determinant(const Matrix& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// Columns of length 1, at right angles, right-handed, each to within kMatrixSlack.
bool is_rotation(const Matrix& m) {
  for (size_t a = 0; a < 3; ++a) {
    for (size_t b = a; b < 3; ++b) {
      const double dot = m[0][a] * m[0][b] + m[1][a] * m[1][b] + m[2][a] * m[2][b];
      if (!(std::abs(dot - (a == b ? 1 : 0)) <= kMatrixSlack)) return false;
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

// The file name in `path`, which may be one of Windows, without the extension of a picture, after
// as many folders as `like` has.
std::string picture_stem(std::string text, const std::string& like) {
  std::ranges::replace(text, '\\', '/');
  std::filesystem::path path(text);
  std::string stem = (is_picture_name(path) ? path.stem() : path.filename()).string();
  for (auto folders = std::ranges::count(like, '/'); folders > 0; --folders) {
    path = path.parent_path();
    stem = path.filename().string() + "/" + stem;
  }
  return stem;
}

// For each picture the number of its frame.
Read<std::vector<size_t>> frames_of(const Json& frames, const CameraPictures& pictures) {
  std::map<std::string, size_t> by_stem;
  for (size_t i = 0; i < frames.size(); ++i) {
    const bool named = frames[i].is_object() && frames[i].contains("file_path") &&
                       frames[i]["file_path"].is_string();
    if (!named) return wrong(fmt::format("frames[{}].file_path must be a text", i));
    const auto stem =
        picture_stem(frames[i]["file_path"].get<std::string>(), pictures.stems.front());
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

}  // namespace

tl::expected<Rig, std::string> rig_of_transforms(const Json& json, const CameraPictures& pictures) {
  const Json& frames = json.at("frames");
  if (!frames.is_array()) return wrong("frames must be an array");
  if (auto fault = lens_fault(json, ""); !fault.empty()) return wrong(std::move(fault));
  const auto numbers = frames_of(frames, pictures);
  if (!numbers) return tl::unexpected(numbers.error());
  Rig rig;
  std::array<std::optional<size_t>, 2> example;  // the first without and with a focal length
  for (const size_t number : *numbers) {
    const TransformsFrame frame{json, frames[number], fmt::format("frames[{}]", number)};
    auto fault = lens_fault(frame.frame, frame.place + ".");
    if (!fault.empty()) return wrong(std::move(fault));
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
    const auto intrinsics = intrinsics_of(frame, pictures.width, pictures.height);
    if (!intrinsics) return tl::unexpected(intrinsics.error());
    if (*intrinsics) rig.intrinsics.push_back(**intrinsics);
    auto& first = example[*intrinsics ? 1 : 0];
    first = first.value_or(number);
  }
  if (example[0]) {
    auto unread = unread_focal_length(frames[*example[0]]) + unread_focal_length(json);
    if (!unread.empty()) return wrong(std::move(unread));
  }
  if (example[0] && example[1]) {
    return wrong(
        fmt::format("frames[{}] has no focal length, as fl_x, but frames[{}] has one; give "
                    "it to each, to the file or to none",
                    *example[0], *example[1]));
  }
  keep_one_of_equals(rig.rotations);
  keep_one_of_equals(rig.intrinsics);
  return rig;
}

}  // namespace hmlfc::io
