// Scene "flat": a plain backdrop in the focal plane, which has no parallax, and one small soft disc
// slightly in front of it. Pixels outside the disc are equal in all views.
#include "scenes/scene.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "scenes/hash_noise.hpp"
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
    const Disc disc = disc_in(row, col);
    uint16_t* pixel = view.samples.data();
    for (uint32_t y = 0; y < view.height; ++y) {
      const Vec3 backdrop = mix(kTop, kBottom, (y + 0.5) / view.height);
      for (uint32_t x = 0; x < view.width; ++x, pixel += 3) {
        const double inside = disc.inside(x, y);
        store(mix(backdrop, kDisc, inside * inside), params_.depth, pixel);
      }
    }
  }

  bool disparities(uint32_t row, uint32_t col, std::span<float> pixels) const override {
    const Disc disc = disc_in(row, col);
    for (size_t i = 0; i < pixels.size(); ++i) {
      const bool inside = disc.inside(static_cast<uint32_t>(i % params_.width),
                                      static_cast<uint32_t>(i / params_.width)) > 0;
      pixels[i] = static_cast<float>(inside ? -params_.baseline_px * kDiscDisparity : 0.0);
    }
    return true;
  }

 private:
  struct Disc {
    double centre_x, centre_y, radius;

    // 1 in the middle, 0 outside.
    double inside(uint32_t x, uint32_t y) const {
      const double right = (x + 0.5 - centre_x) / radius;
      const double down = (y + 0.5 - centre_y) / radius;
      return std::max(0.0, 1.0 - (right * right + down * down));
    }
  };

  Disc disc_in(uint32_t row, uint32_t col) const {
    const double step = params_.baseline_px * kDiscDisparity;
    return {0.5 * params_.width - step * (col - (params_.cols - 1) / 2.0),
            0.5 * params_.height - step * (row - (params_.rows - 1) / 2.0),
            std::max(1.0, std::min(params_.width, params_.height) / 40.0)};
  }

  static constexpr Vec3 kTop = from_rgb(0x7E97AE);
  static constexpr Vec3 kBottom = from_rgb(0xA9B4B4);
  static constexpr Vec3 kDisc = from_rgb(0xD8C48A);

  SceneParams params_;
};

class Noise : public Painter {
 public:
  explicit Noise(const SceneParams& params) : params_(params) {}

  void paint(uint32_t row, uint32_t col, RgbImage& view) const override {
    const uint64_t view_seed = mix_bits(params_.seed) ^ (uint64_t{row} << 12 | col);
    HashStream random(view_seed, 0);
    for (size_t i = 0; i < view.samples.size(); i += 3) {
      const uint64_t bits = random.next();
      for (size_t channel = 0; channel < 3; ++channel) {
        const uint64_t top = bits >> (64 - 16 * (channel + 1)) & 0xFFFFu;
        view.samples[i + channel] = static_cast<uint16_t>(top >> (16 - params_.depth));
      }
    }
  }

 private:
  SceneParams params_;
};

std::unique_ptr<Painter> make_painter(const SceneParams& params) {
  switch (params.scene) {
    case Scene::kCards:
      return make_cards(params);
    case Scene::kKnights:
      return make_knights(params);
    case Scene::kGlass:
      return make_glass(params);
    case Scene::kFlat:
      return std::make_unique<Flat>(params);
    case Scene::kNoise:
      break;
  }
  return std::make_unique<Noise>(params);
}

}  // namespace

std::optional<Scene> scene_from_name(std::string_view name) {
  using Row = std::pair<std::string_view, Scene>;
  constexpr std::array<Row, 5> kNames = {
      Row{"cards", Scene::kCards}, Row{"knights", Scene::kKnights}, Row{"glass", Scene::kGlass},
      Row{"flat", Scene::kFlat}, Row{"noise", Scene::kNoise}};
  for (const auto& [known, scene] : kNames) {
    if (known == name) return scene;
  }
  return std::nullopt;
}

ViewRenderer view_renderer(const SceneParams& params) {
  const std::shared_ptr<const Painter> painter = make_painter(params);
  return [params, painter](uint32_t row, uint32_t col) {
    RgbImage view{params.width, params.height, params.depth, {}};
    view.samples.resize(size_t{params.width} * params.height * 3);
    painter->paint(row, col, view);
    return view;
  };
}

LightField render_scene(const SceneParams& params, unsigned threads, const io::Progress& progress) {
  const LightFieldShape shape{params.rows, params.cols, params.width, params.height, params.depth};
  LightField field(shape);
  const ViewRenderer render = view_renderer(params);
  const auto paint_view = [&](size_t index) {
    const auto row = static_cast<uint32_t>(index / params.cols);
    const auto col = static_cast<uint32_t>(index % params.cols);
    field.set_view(row, col, render(row, col));
  };
  io::for_each_index(size_t{params.rows} * params.cols, threads, progress, paint_view);
  return field;
}

std::optional<Rig> scene_rig(const SceneParams& params) { return make_painter(params)->rig(); }

bool render_disparities(const SceneParams& params, unsigned threads, const io::Progress& progress,
                        const DisparityConsumer& consumer) {
  if (params.scene == Scene::kNoise || params.cameras != Cameras::kGrid) return false;
  const std::unique_ptr<Painter> painter = make_painter(params);
  const auto render_view = [&](size_t index) {
    const auto row = static_cast<uint32_t>(index / params.cols);
    const auto col = static_cast<uint32_t>(index % params.cols);
    std::vector<float> pixels(size_t{params.width} * params.height);
    if (painter->disparities(row, col, pixels)) consumer(row, col, pixels);
  };
  io::for_each_index(size_t{params.rows} * params.cols, threads, progress, render_view);
  return true;
}

}  // namespace hmlfc::scenes
