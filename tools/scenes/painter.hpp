// What paints a view of a scene.
#pragma once

#include <cstdint>
#include <memory>

#include <hmlfc/image.hpp>

#include "scenes/scene.hpp"
#include "scenes/two_plane_camera.hpp"
#include "scenes/world.hpp"

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

/// Casts a ray through each pixel corner; where the four corners of a pixel differ visibly, four
/// more through the pixel. A pixel is the mean of its rays in linear light.
class TracedPainter : public Painter {
 public:
  void paint(uint32_t row, uint32_t col, RgbImage& view) const final;

 protected:
  TracedPainter(const SceneParams& params, const CameraRig& rig) : params_(params), rig_(rig) {}

  /// The linear light that comes back along a camera's ray, which meets `hit` first.
  virtual Vec3 light(const Ray& ray, const Hit& hit) const = 0;

  const SceneParams& params() const { return params_; }
  World& world() { return world_; }
  const World& world() const { return world_; }

 private:
  SceneParams params_;
  CameraRig rig_;
  World world_;
};

}  // namespace hmlfc::scenes
