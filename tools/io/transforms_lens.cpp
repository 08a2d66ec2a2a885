#include "io/transforms_lens.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>
#include <string_view>

#include <fmt/format.h>

#include "io/files.hpp"
#include "io/json_text.hpp"

namespace hmlfc::io {
namespace {

using Json = nlohmann::json;

enum class LensMeaning : uint8_t {
  kNothing,  // of a lens
  kNumber,   // pixels
  kRadians,  // a field of view
  kDegrees,  // likewise
  kModel,    // the name of a kind of lens
  kLens,     // what a pinhole does not have, unless it says nothing
  kAxes,     // other axes of a camera, unless it says nothing
  kOther,    // a focal length in a way, or a unit, that differs from program to program
};

// Names are parted by spaces; *x stands for all that contain x, in any case.
struct LensMembers {
  LensMeaning meaning;
  std::string_view names;
};

// The members of a file or frame that tell a lens, in the files of NeRF, instant-ngp, nerfstudio,
// COLMAP, Blender and their heirs; the first that matches counts. All others are ignored.
constexpr auto kLensMembers = std::to_array<LensMembers>({
    {LensMeaning::kNothing, "*undistort"},
    {LensMeaning::kNumber, "fl_x fl_y cx cy w h"},
    {LensMeaning::kRadians, "camera_angle_x camera_angle_y"},
    {LensMeaning::kDegrees, "x_fov y_fov"},
    {LensMeaning::kModel,
     "camera_model camera_type lens_model lens_type projection projection_type"},
    {LensMeaning::kLens,
     "k1 k2 k3 k4 k5 k6 p1 p2 s1 s2 s3 s4 sx1 sy1 omega xi skew rolling_shutter"},
    {LensMeaning::kLens, "*distort *fisheye *ftheta *equirect *latlong *panoram *ortho"},
    {LensMeaning::kAxes, "from_mitsuba"},
    {LensMeaning::kOther, "K fx fy camera_matrix *fov *focal *intrinsic"},
});

// Lenses that are pinholes where all distortion is 0.
constexpr auto kPinholes =
    std::to_array<std::string_view>({"pinhole", "simple_pinhole", "perspective", "persp", "opencv",
                                     "full_opencv", "radial", "simple_radial"});

LensMeaning meaning_of(const std::string& name) {
  const std::string lower = lower_case(name);
  for (const LensMembers& members : kLensMembers) {
    for (const auto& word : std::views::split(members.names, ' ')) {
      const std::string_view known(word.begin(), word.end());
      const bool found =
          known.starts_with('*') ? lower.find(known.substr(1)) != lower.npos : known == name;
      if (found) return members.meaning;
    }
  }
  return LensMeaning::kNothing;
}

// null, false, 0, "", "false", "0", or an array or object of such.
bool says_nothing(const Json& value) {
  if (value.is_structured()) return std::ranges::all_of(value, says_nothing);
  if (value.is_number()) return value.get<double>() == 0;
  if (!value.is_string()) return value.is_null() || value == Json(false);
  const std::string text = lower_case(value.get<std::string>());
  return text.empty() || text == "false" || text == "0";
}

// What is wrong with `value` of a member: what follows "NAME is VALUE".
std::string fault_of(LensMeaning meaning, std::string_view name, const Json& value) {
  switch (meaning) {
    case LensMeaning::kLens:
      if (says_nothing(value)) return "";
      return ": the cameras of a rig are pinholes; undistort the pictures and leave it out";
    case LensMeaning::kModel: {
      const std::string model = value.is_string() ? lower_case(value.get<std::string>()) : "?";
      if (says_nothing(value) || std::ranges::find(kPinholes, model) != kPinholes.end()) return "";
      return ": the cameras of a rig are pinholes; undistort the pictures and make it PINHOLE";
    }
    case LensMeaning::kAxes:
      return says_nothing(value) ? "" : ": only the axes of NeRF are read; export with those";
    case LensMeaning::kNothing:
    case LensMeaning::kOther:
      return "";
    default:
      break;
  }
  if (!value.is_number() || !std::isfinite(value.get<double>())) return "; it must be a number";
  const auto number = value.get<double>();
  if (meaning == LensMeaning::kRadians && !(number > 0 && number < std::numbers::pi)) {
    return fmt::format(", outside (0, pi) radians; if these are degrees, call it {}_fov",
                       name.back());
  }
  if (meaning == LensMeaning::kDegrees && !(number > 0 && number < 180)) {
    return ", outside (0, 180) degrees";
  }
  return "";
}

// `frame`'s own before the file's.
std::optional<double> number(const TransformsFrame& frame, const char* member) {
  for (const Json* from : {&frame.frame, &frame.file}) {
    if (const auto found = from->find(member); found != from->end()) return found->get<double>();
  }
  return std::nullopt;
}

// In pixels, of a picture whose side along `axis`, x or y, is `side`; the frame's own before the
// file's.
std::optional<double> focal_length(const TransformsFrame& frame, const std::string& axis,
                                   double side) {
  const auto of_angle = [&](double angle) { return side / 2 / std::tan(angle / 2); };
  for (const Json* from : {&frame.frame, &frame.file}) {
    const auto value = [&](const std::string& name) { return from->at(name).get<double>(); };
    if (from->contains("fl_" + axis)) return value("fl_" + axis);
    if (from->contains(axis + "_fov"))
      return of_angle(value(axis + "_fov") * std::numbers::pi / 180);
    if (from->contains("camera_angle_" + axis)) return of_angle(value("camera_angle_" + axis));
  }
  return std::nullopt;
}

}  // namespace

std::string lens_fault(const Json& object, const std::string& place) {
  for (const auto& item : object.items()) {
    const std::string fault = fault_of(meaning_of(item.key()), item.key(), item.value());
    if (fault.empty()) continue;
    const std::string name = shown_json(item.key());
    return place + name.substr(1, name.size() - 2) + " is " + shown_json(item.value()) + fault;
  }
  return "";
}

std::string unread_focal_length(const Json& object) {
  for (const auto& item : object.items()) {
    if (meaning_of(item.key()) != LensMeaning::kOther) continue;
    return shown_json(item.key()) +
           " is not read: say fl_x in pixels, camera_angle_x in radians or x_fov in degrees";
  }
  return "";
}

tl::expected<std::optional<std::array<double, 4>>, std::string> intrinsics_of(
    const TransformsFrame& frame, uint32_t width, uint32_t height) {
  const double aspect = static_cast<double>(width) / height;
  const auto given_w = number(frame, "w");
  const auto given_h = number(frame, "h");
  const double w = given_w ? *given_w : given_h ? *given_h * aspect : width;
  const double h = given_h ? *given_h : w / aspect;
  if (!(w >= 1 && h >= 1)) return tl::unexpected(std::string("w and h must be at least 1"));
  // Sides of smaller copies are whole numbers: each is less than a pixel off.
  if (std::abs(width * h - height * w) > std::max(w, h)) {
    return tl::unexpected(fmt::format(
        "{}: w and h are {} x {}, the pictures {} x {}: another aspect; were they {}?", frame.place,
        w, h, width, height, (w < h) == (width < height) ? "cut" : "turned (EXIF)"));
  }
  const auto of_x = focal_length(frame, "x", w);
  const auto of_y = focal_length(frame, "y", h);
  if (!of_x && !of_y) return std::nullopt;
  const double to_x = width / w;
  const double to_y = height / h;
  return std::array{of_x.value_or(of_y.value_or(0)) * to_x, of_y.value_or(of_x.value_or(0)) * to_y,
                    number(frame, "cx").value_or(w / 2) * to_x - 0.5,
                    number(frame, "cy").value_or(h / 2) * to_y - 0.5};
}

}  // namespace hmlfc::io
