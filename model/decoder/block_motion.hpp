// How a block is predicted from reference images, by a tile record or by a motion tile.
#pragma once

#include <array>

#include "arithmetic/motion.hpp"
#include "syntax/geometry.hpp"
#include "syntax/motion_tile.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc {

/// A displaced reference image.
struct ReferenceMotion {
  ImagePos image;
  SubpelVector vector;
  friend bool operator==(const ReferenceMotion&, const ReferenceMotion&) = default;
};

/// A rectangle of a reference plane, which may reach outside: columns x to x + columns - 1, rows
/// likewise; not empty.
struct ReferenceArea {
  int32_t x = 0;
  int32_t y = 0;
  unsigned columns = 1;
  unsigned rows = 1;
};

/// The motion of a block: no reference without motion, else one or two.
struct BlockMotion {
  unsigned count = 0;
  bool negative = false;  ///< sign -
  std::array<ReferenceMotion, 2> references{};
  friend bool operator==(const BlockMotion&, const BlockMotion&) = default;
};

/// Turns palette entries into motion, for one plane of one predictive image (MOT-7 to MOT-9).
class MotionResolver {
 public:
  /// Serves a stream with motion tiles.
  MotionResolver(const StreamView& stream, int level, ImagePos image, Plane plane);

  /// The motion of blocks with `entry`, which they may use. `disparity` in [-4096, 4095] is used
  /// where the entry shares one.
  BlockMotion resolve(const PaletteEntry& entry, int32_t disparity) const;

  /// K0 to K3 of the image.
  const ReferenceImages& images() const { return images_; }

 private:
  ImagePos image_;
  ReferenceImages images_;
  VectorRules rules_;
  unsigned vector_precision_;
  bool halved_;
};

}  // namespace hmlfc
