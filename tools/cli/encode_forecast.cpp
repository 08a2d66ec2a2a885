#include "cli/encode_forecast.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "cli/output.hpp"
#include "terminal/clock.hpp"

namespace hmlfc::cli {
namespace {

constexpr double kFewPixels = 0x1p23;  // of all views: soon done
constexpr double kLeastShare = 40;     // a part is at most one of so many parts of a view
constexpr double kSoon = 10;           // seconds

// Pixels that trials code: of a preset's images a part of 384 x 256 pixels, with what they refer
// to.
double trial_pixels(const LightFieldShape& shape, const EncodeParams& params) {
  if (params.profile == Profile::kMain) return 0;
  const double part = std::min(shape.width, 384u) * std::min(shape.height, 256u);
  const Preset preset = params.extended.preset;
  const double images = preset == Preset::kFast ? 6 : preset == Preset::kMedium ? 16 : 32;
  const double trials = preset == Preset::kFast ? 3 : 5;
  return trials * part * std::min(1.4 * images, static_cast<double>(shape.rows) * shape.cols);
}

// The middle of each view, `side` pixels wide and high.
LightField middle_of(const LightField& field, uint32_t side) {
  LightFieldShape shape = field.shape();
  const uint32_t left = (shape.width - side) / 2;
  const uint32_t top = (shape.height - side) / 2;
  std::vector<uint16_t> line(size_t{shape.width} * 3);
  shape.width = shape.height = side;
  LightField middle(shape);
  for (uint32_t row = 0; row < shape.rows; ++row) {
    for (uint32_t col = 0; col < shape.cols; ++col) {
      for (uint32_t y = 0; y < side; ++y) {
        field.read_row(row, col, top + y, line);
        middle.write_row(row, col, y, std::span(line).subspan(size_t{left} * 3, size_t{side} * 3));
      }
    }
  }
  return middle;
}

// "40 seconds", "3 minutes" or "1.5 hours".
std::string about(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} seconds", std::ceil(seconds / 5) * 5);
  if (seconds < 5400) return fmt::format("{:.0f} minutes", std::ceil(seconds / 60));
  return fmt::format("{:.1f} hours", seconds / 3600);
}

}  // namespace

std::string encode_forecast(const LightField& field, const EncodeParams& params,
                            const std::optional<EncodeTarget>& target) {
  const LightFieldShape& shape = field.shape();
  const double views = static_cast<double>(shape.rows) * shape.cols;
  const double pixels = views * shape.width * shape.height;
  uint32_t side = 64;
  if (kLeastShare * side * side > pixels / views) side = 32;
  const bool small =
      kLeastShare * side * side > pixels / views || side > shape.width || side > shape.height;
  if (pixels < kFewPixels || small) return "";

  EncodeParams settled = params;  // so that nothing is tried
  if (settled.ref_rows == 0) settled.ref_rows = std::min(5u, shape.rows);
  if (settled.ref_cols == 0) settled.ref_cols = std::min(5u, shape.cols);
  settled.extended.disparity_grid = 8;
  const LightField part = middle_of(field, side);
  const Clock clock;
  if (!encode(part, settled)) return "";
  const double margins = side == 32 ? 1.3 : 1;  // of what a part costs more than as much of a view
  const double second_per_pixel = clock.wall_seconds() / (views * side * side * margins);
  const double attempts = target ? 1.5 : 1;  // as measured: 1.1 to 3
  const double seconds = attempts * second_per_pixel * (pixels + trial_pixels(shape, params));
  if (seconds < kSoon) return "";
  return fmt::format("Encoding {} views of {} x {} pixels will take about {}", views, shape.width,
                     shape.height, about(seconds));
}

void note_forecast(size_t done, size_t parts, double seconds) {
  const double all = static_cast<double>(parts) * seconds / static_cast<double>(done);
  if (parts < 2 || done != (parts + 7) / 8 || all < kSoon) return;
  note(fmt::format("Encoding {} parts will take about {}", parts, about(all)));
}

}  // namespace hmlfc::cli
