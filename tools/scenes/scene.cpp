#include "scenes/scene.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <utility>

#include "scenes/painter.hpp"

namespace hmlfc::scenes {
namespace {

std::unique_ptr<Painter> make_painter(const SceneParams& params) {
  switch (params.scene) {
    case Scene::kCards:
      return make_cards(params);
    case Scene::kKnights:
      return make_knights(params);
    case Scene::kGlass:
      return make_glass(params);
    case Scene::kFlat:
      return make_flat(params);
    case Scene::kNoise:
      break;
  }
  return make_noise(params);
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

LightField render_scene(const SceneParams& params, unsigned threads, const io::Progress& progress) {
  const LightFieldShape shape{params.rows, params.cols, params.width, params.height, params.depth};
  LightField field(shape);
  const std::unique_ptr<Painter> painter = make_painter(params);
  const auto paint_view = [&](size_t index) {
    const auto row = static_cast<uint32_t>(index / params.cols);
    const auto col = static_cast<uint32_t>(index % params.cols);
    RgbImage view{params.width, params.height, params.depth, {}};
    view.samples.resize(size_t{params.width} * params.height * 3);
    painter->paint(row, col, view);
    field.set_view(row, col, view);
  };
  io::for_each_index(size_t{params.rows} * params.cols, threads, progress, paint_view);
  return field;
}

}  // namespace hmlfc::scenes
