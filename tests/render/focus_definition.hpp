// Click to focus by its definition, for the test of hmlfc/focus.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <hmlfc/focus.hpp>

namespace hmlfc::test {

/// The answer of focus_at for one pixel of a frame, as its contract reads, in world coordinates
/// (CAM-1, CAM-2) and real numbers.
class FocusDefinition {
 public:
  FocusDefinition(const Decoder& decoder, const Camera& camera, uint32_t i, uint32_t j)
      : decoder_(decoder), header_(decoder.header()), camera_(with_defaults(camera, header_)) {
    const WorldPoint& p = *camera_.position;
    const WorldPoint& q = *camera_.look_at;
    const double pitch = *camera_.row_pitch;
    const double longer = std::max(*camera_.frame_width, *camera_.frame_height);
    const double a = (2.0 * i + 1 - *camera_.frame_width) * *camera_.tan_half / longer;
    const double b = (2.0 * j + 1 - *camera_.frame_height) * *camera_.tan_half / longer;
    const double gx = q.u - p.u;
    const double gy = pitch * (q.v - p.v);
    const double gz = q.z - p.z;
    const double length = std::sqrt(gx * gx + gy * gy + gz * gz);
    const double flat = std::hypot(gx, gz);
    const double nx = gx / length + a * gz / flat - b * gy * gx / (length * flat);
    const double ny = gy / length + b * flat / length;
    const double nz = gz / length - a * gx / flat - b * gy * gz / (length * flat);
    is_ahead_ = nz > 0.25 && std::abs(nx) < 4 * nz && std::abs(ny) < 4 * nz;
    near(nz, 0.25);
    sx_ = nx / nz;
    sy_ = ny / nz;
    u_ = p.u - p.z * sx_;
    v_ = p.v - p.z * sy_ / pitch;
  }

  /// The answer; meaningless where is_clear() is false then.
  FocusPoint answer() {
    if (!is_ahead_ || !is_on_grid(u_, header_.cols) || !is_on_grid(v_, header_.rows)) {
      return {PixelSight::kOutside, 0, {}};
    }
    const bool is_seen = is_inside(0);
    const std::vector<ViewPos> views = views_near();
    for (const ViewPos& view : views) {
      const auto found = follow(view);
      if (!found) continue;
      if (!is_seen && !is_inside(*found)) return {PixelSight::kOutside, 0, {}};
      is_beside_ = &view != views.data();
      return {PixelSight::kSurface, *found, view};
    }
    return {is_seen ? PixelSight::kUnknown : PixelSight::kOutside, 0, {}};
  }

  /// Whether a view beside the nearest one told, and whether following the ray changed the answer.
  bool is_beside() const { return is_beside_; }
  bool is_moved() const { return is_moved_; }

  /// Whether no number was so near a limit that fixed point may decide otherwise.
  bool is_clear() const { return is_clear_; }

 private:
  void near(double a, double b) {
    if (std::abs(a - b) < 0.01) is_clear_ = false;
  }

  bool is_on_grid(double place, uint32_t views) {
    near(place, -0.5);
    near(place, views - 0.5);
    return views == 1 || (place >= -0.5 && place <= views - 0.5);
  }

  static double clamped(double place, uint32_t views) {
    return std::clamp(place, 0.0, views - 1.0);
  }

  uint32_t nearest(double place, uint32_t views) {
    const double inside = clamped(place, views);
    near(inside - std::floor(inside), 0.5);
    return static_cast<uint32_t>(std::floor(inside + 0.5));
  }

  // Where the point of the ray at a disparity lies in the picture of a view (CAM-1, CAM-2).
  double x_in(ViewPos view, int disparity) const {
    return place_in(u_, view.col, header_.cols, header_.width, 1, sx_, disparity);
  }
  double y_in(ViewPos view, int disparity) const {
    return place_in(v_, view.row, header_.rows, header_.height, *camera_.row_pitch, sy_, disparity);
  }
  double place_in(double place, uint32_t view, uint32_t views, uint32_t size, double pitch,
                  double slope, int disparity) const {
    const double focal_by_depth = camera_.shear - disparity / 256.0;
    return (size - 1) / 2.0 + *camera_.focal * slope + pitch * focal_by_depth * (place - view) +
           pitch * camera_.shear * (view - (views - 1) / 2.0);
  }

  bool is_in_picture(double x, uint32_t size) {
    near(x, -0.5);
    near(x, size - 0.5);
    return x >= -0.5 && x < size - 0.5;
  }

  bool is_inside(int disparity) {
    const ViewPos view{nearest(v_, header_.rows), nearest(u_, header_.cols)};
    return is_in_picture(x_in(view, disparity), header_.width) &&
           is_in_picture(y_in(view, disparity), header_.height);
  }

  std::vector<ViewPos> views_near() {
    const ViewPos middle{nearest(v_, header_.rows), nearest(u_, header_.cols)};
    std::vector<std::pair<double, ViewPos>> found;
    for (uint32_t row = 0; row < header_.rows; ++row) {
      for (uint32_t col = 0; col < header_.cols; ++col) {
        if (std::abs(static_cast<int>(row) - static_cast<int>(middle.row)) > 1 ||
            std::abs(static_cast<int>(col) - static_cast<int>(middle.col)) > 1) {
          continue;
        }
        found.emplace_back(
            std::hypot(row - clamped(v_, header_.rows), col - clamped(u_, header_.cols)),
            ViewPos{row, col});
      }
    }
    std::ranges::stable_sort(found, {}, &std::pair<double, ViewPos>::first);
    std::vector<ViewPos> views;
    for (size_t k = 0; k < found.size(); ++k) {
      if (k > 0 && found[k].first - found[k - 1].first > 0)
        near(found[k].first, found[k - 1].first);
      views.push_back(found[k].second);
    }
    return views;
  }

  std::optional<int16_t> follow(ViewPos view) {
    std::vector<int16_t> steps{0};
    while (steps.size() <= 8) {
      const auto told = median(disparity_map(decoder_, view).value(), x_in(view, steps.back()),
                               y_in(view, steps.back()));
      if (!told) return told;
      is_moved_ = steps.size() > 1 && *told != steps[1];
      if (*told == steps.back()) return told;
      steps.push_back(*told);
    }
    return std::max(steps[7], steps[8]);
  }

  std::optional<int16_t> median(const DisparityMap& map, double x, double y) {
    const auto block = [&](double at, uint32_t size) {
      const double inside = std::clamp(at, 0.0, size - 1.0);
      const double in_blocks = (inside + 0.5) / map.block_size;
      if (inside == at) near(in_blocks, std::round(in_blocks));
      return static_cast<int>(in_blocks);
    };
    std::vector<int16_t> told;
    const int bx = block(x, map.width);
    const int by = block(y, map.height);
    for (int index = 0; index < static_cast<int>(map.blocks.size()); ++index) {
      const int columns = static_cast<int>(map.columns);
      if (std::abs(index % columns - bx) > 1 || std::abs(index / columns - by) > 1) continue;
      const BlockDisparity& one = map.blocks[static_cast<size_t>(index)];
      if (one.confidence > 0) told.push_back(one.disparity);
    }
    std::ranges::sort(told);
    if (told.empty()) return std::nullopt;
    return told[(told.size() - 1) / 2];
  }

  const Decoder& decoder_;
  const StreamHeader& header_;
  Camera camera_;
  bool is_ahead_ = true;
  bool is_clear_ = true;
  bool is_beside_ = false;
  bool is_moved_ = false;
  double sx_ = 0;  // slopes
  double sy_ = 0;
  double u_ = 0;  // place among the views
  double v_ = 0;
};

}  // namespace hmlfc::test
