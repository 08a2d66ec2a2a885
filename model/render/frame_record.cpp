#include <hmlfc/camera.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "arithmetic/widths.hpp"
#include "bits/exact_floats.hpp"

namespace hmlfc {
namespace {

using Checked = tl::expected<void, CameraError>;

constexpr double kMinLength = 0x1p-20;  // CAM-4
constexpr int32_t kMaxReach = 1 << 28;  // REC-3, in 2^-12 pixels
constexpr int64_t kMaxShift = 1 << 29;

struct Vector {
  double x = 0;
  double y = 0;
  double z = 0;
};

struct Pose {
  Vector forward;
  Vector right;
  Vector down;
};

// One of kCameraInputs; another literal does not compile.
struct Input {
  consteval Input(const char* literal) : name(*std::ranges::find(kCameraInputs, literal)) {}

  std::string_view name;
};

tl::unexpected<CameraError> bad(Input input, const std::string& message) {
  return tl::unexpected(CameraError{message, input.name});
}

std::string text(double value) {
  std::array<char, 32> digits;
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), end};
}

// lo <= value <= hi; false for NaN.
bool is_within(double value, double lo, double hi) { return value >= lo && value <= hi; }

// A number of an input: `part` says which one where it has several.
struct Number {
  Input input;
  const char* part;
  double value, lo, hi;
};

Checked check_number(const Number& n) {
  if (is_within(n.value, n.lo, n.hi)) return {};
  return bad(n.input, std::string(n.input.name) + n.part + " is " + text(n.value) + ", outside [" +
                          text(n.lo) + ", " + text(n.hi) + "]");
}

// The inputs in the order of CAM-3.
Checked check_inputs(const Camera& camera, double row_pitch) {
  const WorldPoint& position = *camera.position;
  const WorldPoint& look_at = *camera.look_at;
  const Number numbers[] = {
      {"frame_width", "", static_cast<double>(*camera.frame_width), 1, kMaxFrameSide},
      {"frame_height", "", static_cast<double>(*camera.frame_height), 1, kMaxFrameSide},
      {"focal", "", *camera.focal, 1, 65536},
      {"shear", "", camera.shear, -256, 256},
      {"row_pitch", " without its sign", std::abs(row_pitch), 1.0 / 16, 127.0 / 16},
      {"position", "'s column", position.u, -4096, 8192},
      {"position", "'s row", position.v, -4096, 8192},
      {"position", "'s distance", position.z, -4096, 4096},
      {"position", "'s distance / row_pitch", position.z / row_pitch, -4096, 4096},
      {"look_at", "'s column", look_at.u, -0x1p20, 0x1p20},
      {"look_at", "'s row", look_at.v, -0x1p20, 0x1p20},
      {"look_at", "'s distance", look_at.z, -0x1p20, 0x1p20},
      {"tan_half", "", *camera.tan_half, 0x1p-10, 2},
      {"focus", "", camera.focus, -256, 256},
      {"aperture", "", static_cast<double>(camera.aperture), 0, kMaxAperture},
      {"filter", "", static_cast<double>(camera.filter), 0, 2},
      {"geometry", "", static_cast<double>(camera.geometry), 0, 1},
  };
  for (const Number& number : numbers) {
    if (auto ok = check_number(number); !ok) return ok;
  }
  return {};
}

// CAM-4.
tl::expected<Pose, CameraError> pose_of(const Camera& camera, double row_pitch) {
  const WorldPoint& from = *camera.position;
  const WorldPoint& to = *camera.look_at;
  const Vector g{to.u - from.u, row_pitch * to.v - row_pitch * from.v, to.z - from.z};
  const double length = std::sqrt((g.x * g.x + g.y * g.y) + g.z * g.z);
  if (!(length >= kMinLength))
    return bad("look_at", "look_at is the camera's place: give another point");
  const Vector forward{g.x / length, g.y / length, g.z / length};
  const double h = std::sqrt(forward.x * forward.x + forward.z * forward.z);
  if (!(h >= kMinLength)) {
    return bad("look_at", "look_at is straight above or below the camera: move it aside");
  }
  const Vector right{forward.z / h, 0, -forward.x / h};
  const Vector down{forward.y * right.z, forward.z * right.x - forward.x * right.z,
                    -(forward.y * right.x)};
  return Pose{forward, right, down};
}

// REC-1; |x * 2^k| < 2^52.
int64_t fix(double x, int k) { return static_cast<int64_t>(std::floor(std::ldexp(x, k) + 0.5)); }

int32_t fix32(double x, int k) { return static_cast<int32_t>(fix(x, k)); }

// hi and lo of REC-2 for the components of `v`.
void split(const Vector& v, IntVector& hi, IntVector& lo) {
  const auto split_one = [](double value, int32_t& high, int32_t& low) {
    const int64_t e = fix(value, 40);
    high = static_cast<int32_t>(e >> 12);
    low = static_cast<int32_t>(e - 4096 * int64_t{high});
  };
  split_one(v.x, hi.x, lo.x);
  split_one(v.y, hi.y, lo.y);
  split_one(v.z, hi.z, lo.z);
}

Vector scaled(const Vector& v, double factor) { return {v.x * factor, v.y * factor, v.z * factor}; }

// The directions of REC-2.
void set_directions(const Pose& pose, double tan_half, FrameRecord& record) {
  const double longer = std::max(record.frame_width, record.frame_height);
  split(pose.forward, record.n0_hi, record.n0_lo);
  split(scaled(pose.right, tan_half / longer), record.na_hi, record.na_lo);
  split(scaled(pose.down, tan_half / longer), record.nb_hi, record.nb_lo);
}

// fine of REC-2: above 0 where what has disparity 0 lies on whole pixels of all views.
int32_t fine_of(const Camera& camera, const Pose& pose, const StreamHeader& header) {
  const uint32_t width = *camera.frame_width;
  const uint32_t height = *camera.frame_height;
  const bool whole =
      pose.forward.z == 1 && camera.shear == 0 &&
      fix(2 * *camera.focal * *camera.tan_half, 12) == int64_t{std::max(width, height)} << 12 &&
      width % 2 == header.width % 2 && height % 2 == header.height % 2;
  return whole ? static_cast<int32_t>(256 / std::max(1.0, std::abs(*camera.row_pitch))) : 0;
}

int32_t nearest_view(double place, int32_t views) {
  return static_cast<int32_t>(std::clamp(std::floor(place + 0.5), 0.0, views - 1.0));
}

// x0, y0, gain, dx and dy of REC-2 within the limits of REC-3.
Checked set_pictures(const Camera& camera, double row_pitch, FrameRecord& record) {
  const double kappa = camera.shear - camera.focus;
  const WorldPoint& p = *camera.position;
  const double c0 = record.c0;
  const double r0 = record.r0;
  const int64_t x0 = fix((((record.width - 1) / 2.0) + kappa * (p.u - c0)) +
                             camera.shear * (c0 - (record.cols - 1) / 2.0),
                         12);
  const int64_t y0 = fix((((record.height - 1) / 2.0) + (row_pitch * kappa) * (p.v - r0)) +
                             (row_pitch * camera.shear) * (r0 - (record.rows - 1) / 2.0),
                         12);
  const int64_t gain = fix(*camera.focal - kappa * p.z, 12);
  const int64_t dx = fix(camera.focus, 12);
  const int64_t dy = fix(row_pitch * camera.focus, 12);
  if (std::abs(gain) > kMaxReach) {
    return bad("position", "position is too far from the views for this shear and focus");
  }
  if (std::abs(x0) > kMaxReach || std::abs(y0) > kMaxReach) {
    return bad("position", "position is too far aside of the views for this shear and focus");
  }
  if (std::abs(dx) * (record.cols - 1) > kMaxShift ||
      std::abs(dy) * (record.rows - 1) > kMaxShift) {
    return bad("focus", "focus is too large for this many views");
  }
  record.x0 = static_cast<int32_t>(x0);
  record.y0 = static_cast<int32_t>(y0);
  record.gain = static_cast<int32_t>(gain);
  record.dx = static_cast<int32_t>(dx);
  record.dy = static_cast<int32_t>(dy);
  return {};
}

}  // namespace

Camera with_defaults(const Camera& camera, const StreamHeader& header) {
  Camera full = camera;
  const double width = header.width;
  const double height = header.height;
  if (!full.frame_width) full.frame_width = header.width;
  if (!full.frame_height) full.frame_height = header.height;
  if (!full.focal) full.focal = std::max(width, height);
  if (!full.row_pitch) full.row_pitch = header.row_scale == 0 ? 1 : header.row_scale / 16.0;
  if (!full.position) full.position = {(header.cols - 1) / 2.0, (header.rows - 1) / 2.0, 0};
  if (!full.look_at) full.look_at = {full.position->u, full.position->v, full.position->z + 1};
  if (!full.tan_half) {
    const double longer = std::max(*full.frame_width, *full.frame_height);
    full.tan_half = longer * std::min(width / *full.frame_width, height / *full.frame_height) /
                    (2 * *full.focal);
  }
  return full;
}

tl::expected<FrameRecord, CameraError> frame_record(const Camera& camera,
                                                    const StreamHeader& header) {
  const Camera full = with_defaults(camera, header);
  const double row_pitch = *full.row_pitch;
  if (auto ok = check_inputs(full, row_pitch); !ok) return tl::unexpected(ok.error());
  const auto pose = pose_of(full, row_pitch);
  if (!pose) return tl::unexpected(pose.error());

  FrameRecord record;
  record.frame_width = static_cast<int32_t>(*full.frame_width);
  record.frame_height = static_cast<int32_t>(*full.frame_height);
  record.filter = static_cast<int32_t>(full.filter);
  record.aperture = full.aperture;
  record.cols = static_cast<int32_t>(header.cols);
  record.rows = static_cast<int32_t>(header.rows);
  record.width = static_cast<int32_t>(header.width);
  record.height = static_cast<int32_t>(header.height);
  set_directions(*pose, *full.tan_half, record);
  record.u0 = fix32(full.position->u, 16);
  record.v0 = fix32(full.position->v, 16);
  record.zu = fix32(full.position->z, 16);
  record.zv = fix32(full.position->z / row_pitch, 16);
  watch("u0, v0", record.u0);
  watch("u0, v0", record.v0);
  watch("zu, zv", record.zu);
  watch("zu, zv", record.zv);
  record.c0 = nearest_view(full.position->u, record.cols);
  record.r0 = nearest_view(full.position->v, record.rows);
  if (auto ok = set_pictures(full, row_pitch, record); !ok) return tl::unexpected(ok.error());
  record.geometry = full.aperture == 0 ? static_cast<int32_t>(full.geometry) : 0;
  record.focus = fix32(full.focus, 8);
  record.pitch = fix32(row_pitch, 8);
  record.fine = fine_of(full, *pose, header);
  return record;
}

}  // namespace hmlfc
