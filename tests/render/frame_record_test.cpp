// From cameras to records: every interval, every error, and worked records.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <hmlfc/camera.hpp>

#include "render/ray.hpp"
#include "render/render_cases.hpp"
#include "render/taps.hpp"

namespace hmlfc {
namespace {

StreamHeader small_header() {
  StreamHeader header;
  header.rows = 3;
  header.cols = 5;
  header.width = 64;
  header.height = 48;
  return header;
}

std::string complaint(const Camera& camera) {
  const auto record = frame_record(camera, small_header());
  return record ? "" : record.error().message;
}

// A straight camera at view (1, 2), worked by hand from REC-2.
TEST(FrameRecord, StraightAheadByHand) {
  const auto record = frame_record(Camera{}, small_header());
  ASSERT_TRUE(record.has_value());
  EXPECT_EQ(record->n0_hi, (IntVector{0, 0, 1 << 28}));
  EXPECT_EQ(record->na_hi, (IntVector{1 << 21, 0, 0}));  // tan_half / L = 2^-7
  EXPECT_EQ(record->nb_hi, (IntVector{0, 1 << 21, 0}));
  EXPECT_EQ(record->n0_lo, IntVector{});
  EXPECT_EQ(record->u0, 2 << 16);
  EXPECT_EQ(record->v0, 1 << 16);
  EXPECT_EQ(record->zu, 0);
  EXPECT_EQ(record->x0, 63 << 11);
  EXPECT_EQ(record->y0, 47 << 11);
  EXPECT_EQ(record->gain, 64 << 12);
  EXPECT_EQ(record->c0, 2);
  EXPECT_EQ(record->r0, 1);
}

// REC-2: fine is above 0 where frames have the pixels of views.
TEST(FrameRecord, FineByHand) {
  const auto fine = [](const auto& set) {
    Camera camera;
    set(camera);
    return frame_record(camera, small_header())->fine;
  };
  EXPECT_EQ(fine([](Camera&) {}), 256);
  EXPECT_EQ(fine([](Camera& c) { c.row_pitch = 1.0 / 16; }), 256);
  EXPECT_EQ(fine([](Camera& c) { c.row_pitch = -2.5; }), 102);
  EXPECT_EQ(fine([](Camera& c) { c.position = WorldPoint{1.3, 0.7, 2.5}; }), 256);
  EXPECT_EQ(fine([](Camera& c) { c.frame_width = 32, c.tan_half = 0.375; }), 256);
  EXPECT_EQ(fine([](Camera& c) { c.frame_width = 63, c.tan_half = 63 / 128.0; }), 0);
  EXPECT_EQ(fine([](Camera& c) { c.frame_height = 47; }), 0);
  EXPECT_EQ(fine([](Camera& c) { c.tan_half = 0.5 + 0x1p-21; }), 256);
  EXPECT_EQ(fine([](Camera& c) { c.tan_half = 0.5 + 0x1p-20; }), 0);
  EXPECT_EQ(fine([](Camera& c) { c.shear = 1; }), 0);
  EXPECT_EQ(fine([](Camera& c) { c.look_at = WorldPoint{2.01, 1, 1}; }), 0);
}

// CAM-3.
TEST(FrameRecord, EveryInputIsChecked) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity, 1e9}) {
    const auto expect = [&](const char* name, const auto& set) {
      Camera camera;
      set(camera, bad);
      EXPECT_NE(complaint(camera).find(name), std::string::npos) << complaint(camera);
    };
    expect("focal", [](Camera& c, double x) { c.focal = x; });
    expect("shear", [](Camera& c, double x) { c.shear = x; });
    expect("row_pitch", [](Camera& c, double x) { c.row_pitch = x; });
    expect("position's column", [](Camera& c, double x) { c.position = WorldPoint{x, 0, 0}; });
    expect("position's row", [](Camera& c, double x) { c.position = WorldPoint{0, x, 0}; });
    expect("position's distance", [](Camera& c, double x) { c.position = WorldPoint{0, 0, x}; });
    expect("look_at's column", [](Camera& c, double x) { c.look_at = WorldPoint{x, 0, 1}; });
    expect("look_at's row", [](Camera& c, double x) { c.look_at = WorldPoint{0, x, 1}; });
    expect("look_at's distance", [](Camera& c, double x) { c.look_at = WorldPoint{0, 0, x}; });
    expect("tan_half", [](Camera& c, double x) { c.tan_half = x; });
    expect("focus", [](Camera& c, double x) { c.focus = x; });
  }
  Camera camera;
  camera.tan_half = 0;
  EXPECT_NE(complaint(camera).find("tan_half is 0, outside"), std::string::npos);
  camera = {};
  camera.frame_width = 0;
  EXPECT_NE(complaint(camera).find("frame_width"), std::string::npos);
  camera.frame_width = 4097;
  EXPECT_NE(complaint(camera).find("[1, 4096]"), std::string::npos);
  camera = {};
  camera.aperture = 4;
  EXPECT_NE(complaint(camera).find("aperture"), std::string::npos);
  camera = {};
  camera.row_pitch = 0.0625;
  camera.position = WorldPoint{0, 0, 300};
  EXPECT_NE(complaint(camera).find("distance / row_pitch"), std::string::npos);
}

TEST(FrameRecord, CamerasThatLookNowhere) {
  Camera camera;
  camera.position = WorldPoint{1, 1, -2};
  camera.look_at = WorldPoint{1, 1, -2};
  EXPECT_NE(complaint(camera).find("camera's place"), std::string::npos);
  camera.look_at = WorldPoint{1, 4, -2};
  EXPECT_NE(complaint(camera).find("straight above"), std::string::npos);
  camera.look_at = WorldPoint{1, 1, -3};  // away from the scene: every pixel is outside
  const auto record = frame_record(camera, small_header());
  ASSERT_TRUE(record.has_value());
  for (int32_t i = 0; i < record->frame_width; ++i) EXPECT_FALSE(trace(*record, i, 7).has_value());
}

TEST(FrameRecord, CamerasTooFarAway) {
  Camera camera;
  camera.shear = 256;
  camera.position = WorldPoint{2, 1, 4096};
  EXPECT_NE(complaint(camera).find("too far from the views"), std::string::npos);
  camera.position = WorldPoint{8192, 1, 0};
  EXPECT_NE(complaint(camera).find("too far aside"), std::string::npos);
  StreamHeader header = small_header();
  header.cols = 4096;
  camera = {};
  camera.focus = 256;
  camera.shear = 256;
  camera.position = WorldPoint{2047, 1, 0};
  EXPECT_NE(frame_record(camera, header).error().message.find("focus is too large"),
            std::string::npos);
}

// The intervals of section 6 on random records, up to the ends of CAM-3 and REC-3.
TEST(FrameRecord, RaysStayWithinTheirWidths) {
  test::Random random(5);
  const auto extreme = [&](double lo, double hi) {
    const uint32_t pick = random() % 4;
    return pick == 0 ? lo : pick == 1 ? hi : lo + (hi - lo) * (random() / 4294967296.0);
  };
  int made = 0;
  for (int n = 0; n < 20000; ++n) {
    StreamHeader header;
    header.rows = 1 + random() % 4096;
    header.cols = random() % 2 == 0 ? 4096 : 1 + random() % 64;
    header.width = random() % 2 == 0 ? 65536 : 1 + random() % 4096;
    header.height = random() % 2 == 0 ? 65536 : 1 + random() % 4096;
    Camera camera;
    camera.frame_width = random() % 2 == 0 ? 4096 : 1 + random() % 4096;
    camera.frame_height = random() % 2 == 0 ? 4096 : 1 + random() % 4096;
    camera.focal = extreme(1, 65536);
    const double most = std::ldexp(1.0, -static_cast<int>(random() % 12));
    camera.shear = extreme(-256, 256) * most;
    camera.focus = extreme(-256, 256) * most;
    camera.row_pitch = extreme(1.0 / 16, 127.0 / 16) * (random() % 2 == 0 ? 1 : -1);
    camera.position = WorldPoint{extreme(-4096, 8192), extreme(-4096, 8192), extreme(-256, 256)};
    camera.look_at =
        WorldPoint{camera.position->u + extreme(-3, 3), camera.position->v + extreme(-3, 3),
                   camera.position->z + extreme(-1, 3)};
    camera.tan_half = extreme(0x1p-10, 2);
    const auto record = frame_record(camera, header);
    if (!record) continue;
    ++made;
    for (int corner = 0; corner < 8; ++corner) {
      const int32_t i = corner % 2 == 0 ? 0 : record->frame_width - 1;
      const int32_t j = corner / 2 % 2 == 0 ? 0 : record->frame_height - 1;
      const IntVector d =
          direction(*record, 2 * i + 1 - record->frame_width, 2 * j + 1 - record->frame_height);
      for (const int32_t part : {d.x, d.y, d.z}) ASSERT_LE(std::abs(part), 805131609);
      const auto slope = slopes(d);
      if (!slope) continue;
      ASSERT_LT(std::abs(int64_t{slope->x}), (int64_t{1} << 30) + 1);
      const int64_t u = int64_t{record->u0} - ((int64_t{record->zu} * slope->x) >> 28);
      const int64_t xb = int64_t{record->x0} + ((int64_t{record->gain} * slope->x) >> 28);
      const int64_t yb = int64_t{record->y0} + ((int64_t{record->gain} * slope->y) >> 28);
      ASSERT_EQ(u, static_cast<int32_t>(u));
      for (const int64_t c : {0, record->cols - 1}) {
        const int64_t x = xb + int64_t{record->dx} * (c - record->c0);
        ASSERT_LE(std::abs(x), (int64_t{1} << 28) + (1 << 30) + (1 << 29));
      }
      for (const int64_t r : {0, record->rows - 1}) {
        const int64_t y = yb + int64_t{record->dy} * (r - record->r0);
        ASSERT_LE(std::abs(y), (int64_t{1} << 28) + (1 << 30) + (1 << 29));
      }
    }
  }
  EXPECT_GT(made, 1000);
}

TEST(ViewWeights, SumTo256AndAreAllAboveZero) {
  for (int aperture = 0; aperture <= kMaxAperture; ++aperture) {
    for (int32_t place = 0; place <= 9 << 16; place += 37) {
      const AxisWeights axis = axis_weights(place, aperture);
      int32_t sum = 0;
      for (int32_t i = 0; i < axis.count; ++i) {
        ASSERT_GE(axis.weight(i), 1);
        sum += axis.weight(i);
      }
      ASSERT_EQ(sum, 256) << place << " " << aperture;
      const GridWeights grid(axis, 10);
      int32_t in_grid = 0;
      for (int32_t view = grid.first(); view <= grid.last(); ++view) {
        ASSERT_GE(grid.weight(view), 1);
        in_grid += grid.weight(view);
      }
      ASSERT_EQ(in_grid, 256);
    }
  }
  const AxisWeights axis = axis_weights((2 << 16) + (1 << 14), 0);
  EXPECT_EQ(axis.first, 2);
  EXPECT_EQ(axis.weight(0), 192);
  EXPECT_EQ(axis.weight(1), 64);
}

}  // namespace
}  // namespace hmlfc
