// Scene "flat": an even backdrop in the focal plane, where nothing moves, and one small soft disc
// a little before it. All pixels but those of the disc are exactly equal in all views.
#include <algorithm>
#include <cstddef>

#include "scenes/painter.hpp"
#include "scenes/tone.hpp"
#include "scenes/vec3.hpp"

namespace hmlfc::scenes {
namespace {

constexpr double kDiscDisparity = 0.125;  // 1 / z - 1 / z_focus

class Flat : public Painter {
 public:
  explicit Flat(const SceneParams& params) : params_(params) {}

  void paint(uint32_t row, uint32_t col, RgbImage& view) const override {
    const double step = params_.baseline_px * kDiscDisparity;
    const double centre_x = 0.5 * view.width - step * (col - (params_.cols - 1) / 2.0);
    const double centre_y = 0.5 * view.height - step * (row - (params_.rows - 1) / 2.0);
    const double radius = std::max(1.0, std::min(view.width, view.height) / 40.0);
    uint16_t* pixel = view.samples.data();
    for (uint32_t y = 0; y < view.height; ++y) {
      const Vec3 backdrop = mix(kTop, kBottom, (y + 0.5) / view.height);
      for (uint32_t x = 0; x < view.width; ++x, pixel += 3) {
        const double right = (x + 0.5 - centre_x) / radius;
        const double down = (y + 0.5 - centre_y) / radius;
        const double inside = std::max(0.0, 1.0 - (right * right + down * down));
        store(mix(backdrop, kDisc, inside * inside), params_.depth, pixel);
      }
    }
  }

 private:
  static constexpr Vec3 kTop = from_rgb(0x7E97AE);
  static constexpr Vec3 kBottom = from_rgb(0xA9B4B4);
  static constexpr Vec3 kDisc = from_rgb(0xD8C48A);

  SceneParams params_;
};

}  // namespace

std::unique_ptr<Painter> make_flat(const SceneParams& params) {
  return std::make_unique<Flat>(params);
}

}  // namespace hmlfc::scenes
