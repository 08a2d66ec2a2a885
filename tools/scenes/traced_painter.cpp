#include "scenes/painter.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "scenes/tone.hpp"

namespace hmlfc::scenes {
namespace {

/// True where two of the lights differ by more than about 6 % of full scale in the picture, whose
/// samples are the square roots of light. d(sqrt(l)) = dl / (2 sqrt(l)), so the squares of both
/// sides are compared: no root is taken.
bool differ_visibly(double a, double b, double c, double d) {
  const double least = std::min(std::min(a, b), std::min(c, d));
  const double most = std::max(std::max(a, b), std::max(c, d));
  const double spread = most - least;
  constexpr double kTolerance = 0.06;
  return spread * spread > 4.0 * kTolerance * kTolerance * (least + 0.002);
}

bool differ_visibly(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  return differ_visibly(a.y, b.y, c.y, d.y) || differ_visibly(a.x, b.x, c.x, d.x) ||
         differ_visibly(a.z, b.z, c.z, d.z);
}

struct PixelPoint {
  double x;
  double y;
};

// Four points of a pixel, each in a row and a column of its own.
constexpr std::array<PixelPoint, 4> kInnerPoints = {
    {{0.125, 0.625}, {0.375, 0.125}, {0.625, 0.875}, {0.875, 0.375}}};

/// Light at the corners between two pixel rows.
template <class Trace>
void trace_corners(const Trace& trace, uint32_t y, uint32_t width, uint32_t height,
                   std::vector<Vec3>& corners) {
  for (uint32_t x = 0; x <= width; ++x) {
    corners[x] = trace(x, y, std::min(x, width - 1), std::min(y, height - 1));
  }
}

}  // namespace

void TracedPainter::paint(uint32_t row, uint32_t col, RgbImage& view) const {
  const ViewCamera camera(rig_, params_, row, col);
  const TileBins bins(world_, camera, view.width, view.height);
  const auto trace = [&](double x, double y, uint32_t px, uint32_t py) {
    const Ray ray = camera.ray(x, y);
    return light(ray, bins.first_hit(ray, px, py));
  };
  std::vector<Vec3> upper(size_t{view.width} + 1);
  std::vector<Vec3> lower(size_t{view.width} + 1);
  trace_corners(trace, 0, view.width, view.height, lower);
  uint16_t* pixel = view.samples.data();
  for (uint32_t y = 0; y < view.height; ++y) {
    std::swap(upper, lower);
    trace_corners(trace, y + 1, view.width, view.height, lower);
    for (uint32_t x = 0; x < view.width; ++x, pixel += 3) {
      Vec3 sum = (upper[x] + upper[x + 1] + lower[x] + lower[x + 1]) * 0.25;
      if (differ_visibly(upper[x], upper[x + 1], lower[x], lower[x + 1])) {
        for (const PixelPoint& point : kInnerPoints) {
          sum = sum + trace(x + point.x, y + point.y, x, y);
        }
        sum = sum * 0.2;
      }
      store(sum, params_.depth, pixel);
    }
  }
}

bool TracedPainter::disparities(uint32_t row, uint32_t col, std::span<float> pixels) const {
  const ViewCamera camera(rig_, params_, row, col);
  const TileBins bins(world_, camera, params_.width, params_.height);
  const double scale = params_.baseline_px * rig_.depth_unit;
  for (uint32_t y = 0; y < params_.height; ++y) {
    for (uint32_t x = 0; x < params_.width; ++x) {
      const Ray ray = camera.ray(x + 0.5, y + 0.5);
      const Hit hit = bins.first_hit(ray, x, y);
      const double distance = hit.shape != nullptr ? hit.t : background(ray);
      pixels[size_t{y} * params_.width + x] =
          static_cast<float>(scale * (1.0 / rig_.focus - 1.0 / distance));
    }
  }
  return true;
}

}  // namespace hmlfc::scenes
