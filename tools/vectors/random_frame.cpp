#include "vectors/random_frame.hpp"

#include "vectors/random.hpp"

namespace hmlfc::vectors {
namespace {

// Numbers that are exact in binary, so that a text of them is short.
class Draw {
 public:
  explicit Draw(uint64_t seed) : random_(seed) {}

  uint32_t below(uint32_t count) { return static_cast<uint32_t>(random_.below(count)); }
  bool one_in(uint32_t count) { return below(count) == 0; }

  // A multiple of 2^-4, or for one in four of 2^-17, in [-reach, reach].
  double number(double reach) {
    const double steps = one_in(4) ? 0x1p17 : 0x1p4;
    const auto count = static_cast<uint32_t>(2 * reach * steps) + 1;
    return (below(count) - reach * steps) / steps;
  }

 private:
  Random random_;
};

void draw_place(Draw& draw, const StreamHeader& header, hmlfc_dut_camera& camera) {
  if (draw.one_in(8)) return;
  camera.pu = (header.cols - 1) / 2.0 + draw.number(header.cols / 2.0);
  camera.pv = (header.rows - 1) / 2.0 + draw.number(header.rows / 2.0);
  camera.pz = draw.one_in(2) ? 0 : draw.number(4);
  if (draw.one_in(2)) return;
  camera.qu = camera.pu + draw.number(2);
  camera.qv = camera.pv + draw.number(2);
  camera.qz = camera.pz + 2 + draw.number(2);
}

hmlfc_dut_camera draw_camera(Draw& draw, const StreamHeader& header) {
  constexpr uint32_t kSide = 24;  // the largest frame
  hmlfc_dut_camera camera = default_dut_camera();
  camera.frame_width = 1 + draw.below(kSide);
  camera.frame_height = 1 + draw.below(kSide);
  draw_place(draw, header, camera);
  if (draw.one_in(2)) camera.focus = draw.number(4);
  if (draw.one_in(4)) camera.shear = draw.number(4);
  if (draw.one_in(4)) camera.focal = 8 + draw.below(64);
  if (draw.one_in(2)) camera.tan_half = 0.25 + draw.below(8) / 8.0;
  if (draw.one_in(8)) camera.row_pitch = draw.one_in(2) ? 2.5 : -0.75;
  camera.filter = draw.below(3);
  if (draw.one_in(4)) camera.aperture = draw.below(4);
  if (draw.one_in(2)) camera.geometry = 1;
  return camera;
}

}  // namespace

FrameCase random_frame(uint64_t seed, const StreamHeader& header) {
  Draw draw(seed);
  FrameCase frame;
  if (draw.one_in(8)) {
    frame.map.emplace().view = {draw.below(header.rows), draw.below(header.cols)};
    return frame;
  }
  frame.camera = draw_camera(draw, header);
  if (draw.one_in(4)) {
    frame.stop_level = static_cast<int>(draw.below(static_cast<uint32_t>(header.tree_height) + 1));
  }
  return frame;
}

}  // namespace hmlfc::vectors
