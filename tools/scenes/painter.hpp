// Painters render the views of a scene.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include <hmlfc/image.hpp>
#include <hmlfc/rig.hpp>

#include "scenes/scene.hpp"
#include "scenes/view_camera.hpp"
#include "scenes/world.hpp"

namespace hmlfc::scenes {

class Painter {
 public:
  virtual ~Painter() = default;

  /// Renders view (row, col) into `view`, which has the size and depth of the scene's parameters.
  /// Thread-safe.
  virtual void paint(uint32_t row, uint32_t col, RgbImage& view) const = 0;

  /// Writes the disparity of each pixel of view (row, col), row by row, as render_disparities()
  /// has it. False: the scene has none. Thread-safe.
  virtual bool disparities([[maybe_unused]] uint32_t row, [[maybe_unused]] uint32_t col,
                           [[maybe_unused]] std::span<float> pixels) const {
    return false;
  }

  /// The cameras of all views; nothing: the scene has none.
  virtual std::optional<Rig> rig() const { return std::nullopt; }
};

std::unique_ptr<Painter> make_cards(const SceneParams& params);
std::unique_ptr<Painter> make_knights(const SceneParams& params);
std::unique_ptr<Painter> make_glass(const SceneParams& params);

/// Casts a ray through each pixel corner; where the four corners of a pixel differ visibly, four
/// more through the pixel. A pixel is the mean of its rays in linear light.
class TracedPainter : public Painter {
 public:
  void paint(uint32_t row, uint32_t col, RgbImage& view) const final;

  /// Of what the ray through the middle of a pixel meets first.
  bool disparities(uint32_t row, uint32_t col, std::span<float> pixels) const final;

  std::optional<Rig> rig() const final { return rig_of(rig_, params_); }

 protected:
  TracedPainter(const SceneParams& params, const CameraRig& rig) : params_(params), rig_(rig) {}

  /// The linear light that arrives along a camera ray whose first hit is `hit`.
  virtual Vec3 light(const Ray& ray, const Hit& hit) const = 0;

  /// The t at which a ray that hits no shape meets what is behind them, > 0; infinity: nothing.
  virtual double background([[maybe_unused]] const Ray& ray) const {
    return std::numeric_limits<double>::infinity();
  }

  const SceneParams& params() const { return params_; }
  World& world() { return world_; }
  const World& world() const { return world_; }

 private:
  SceneParams params_;
  CameraRig rig_;
  World world_;
};

}  // namespace hmlfc::scenes
