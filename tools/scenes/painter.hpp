// A scene that is ready to be painted from any place of the view grid.
#pragma once

#include <cstdint>
#include <memory>

#include <hmlfc/image.hpp>

#include "scenes/scene.hpp"

namespace hmlfc::scenes {

class Painter {
 public:
  virtual ~Painter() = default;

  /// Fills `view`, which has the size and depth of the scene's parameters, with the picture of view
  /// (row, col). Safe to run on several threads at once.
  virtual void paint(uint32_t row, uint32_t col, RgbImage& view) const = 0;
};

std::unique_ptr<Painter> make_cards(const SceneParams& params);
std::unique_ptr<Painter> make_knights(const SceneParams& params);
std::unique_ptr<Painter> make_glass(const SceneParams& params);
std::unique_ptr<Painter> make_flat(const SceneParams& params);
std::unique_ptr<Painter> make_noise(const SceneParams& params);

}  // namespace hmlfc::scenes
