// The common part of the scenes that are painted by casting rays.
#pragma once

#include "scenes/painter.hpp"
#include "scenes/two_plane_camera.hpp"
#include "scenes/world.hpp"

namespace hmlfc::scenes {

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
