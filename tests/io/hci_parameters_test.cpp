// parameters.cfg of the 4D Light Field Benchmark.
#include "io/hci_parameters.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace hmlfc::io {
namespace {

// As the benchmark's files have it; one pixel of shift is 85 mm * 400 pixels / 34 m.
const std::string kText = R"([intrinsics]
focal_length_mm = 100.0
image_resolution_x_px = 200
image_resolution_y_px = 160
sensor_size_mm = 50.0
fstop = 100.0

[extrinsics]
num_cams_x = 3
num_cams_y = 2
baseline_mm = 85.0
focus_distance_m = 34.0
center_cam_x_m = 0.0
center_cam_rx_rad = 1.57
offset = 0.0

[meta]
scene = antinous
authors = Katrin Honauer & Ole Johannsen,
 and a line more
disp_min = -3.3
)";

ViewList views_of(uint32_t rows, uint32_t cols, const std::vector<uint32_t>& numbers) {
  ViewList views{rows, cols, {}};
  for (const uint32_t number : numbers) {
    views.files.push_back("input_Cam" + std::to_string(number) + ".png");
  }
  return views;
}

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const size_t at = text.find(old);
  EXPECT_NE(at, text.npos) << old;
  return text.replace(at, old.size(), replacement);
}

TEST(HciParameters, CamerasInMetresAndPixels) {
  const auto read = parse_hci_parameters(kText);
  ASSERT_TRUE(read) << read.error();
  const LightFieldShape shape{2, 3, 200, 160, 8};
  const auto rig = rig_of_hci(*read, views_of(2, 3, {0, 1, 2, 3, 4, 5}), shape);
  ASSERT_TRUE(rig) << rig.error();
  EXPECT_EQ(rig->metres_per_unit, 1);
  EXPECT_TRUE(rig->rotations.empty());
  using Position = std::array<double, 3>;
  EXPECT_EQ(rig->positions[0], (Position{-0.085, -0.0425, 0}));
  EXPECT_EQ(rig->positions[5], (Position{0.085, 0.0425, 0}));
  // A point on the plane of focus is at the same pixel of all: cx + fx * (0 - x) / 34.
  for (size_t i = 0; i < 6; ++i) {
    const auto& [fx, fy, cx, cy] = rig->intrinsics[i];
    EXPECT_EQ(fx, 400);
    EXPECT_EQ(fy, 400);
    EXPECT_NEAR(cx - fx * rig->positions[i][0] / 34, 99.5, 1e-9) << i;
    EXPECT_NEAR(cy - fy * rig->positions[i][1] / 34, 79.5, 1e-9) << i;
  }
  EXPECT_NEAR(rig->intrinsics[5][2], 100.5, 1e-9);
}

TEST(HciParameters, PartsOfTheGridAndOtherSizes) {
  const auto read = parse_hci_parameters(with(kText, "34.0", "0"));
  ASSERT_TRUE(read) << read.error();
  const auto part = rig_of_hci(*read, views_of(1, 2, {3, 5}), {1, 2, 100, 80, 8});
  ASSERT_TRUE(part) << part.error();
  EXPECT_EQ(part->positions[1], (std::array<double, 3>{0.085, 0.0425, 0}));
  EXPECT_EQ(part->intrinsics, (std::vector<std::array<double, 4>>{{200, 200, 49.5, 39.5}}));
  const auto beyond = rig_of_hci(*read, views_of(1, 1, {6}), {1, 1, 200, 160, 8});
  EXPECT_EQ(beyond.error(), "it has 2 x 3 cameras, and none of the view input_Cam6.png");
  const auto pressed = rig_of_hci(*read, views_of(1, 2, {3, 4}), {1, 2, 100, 160, 8});
  EXPECT_EQ(pressed.error(), "image_resolution is 200 x 160, the views 100 x 160: another aspect");
  const auto torn = rig_of_hci(*read, views_of(2, 2, {0, 1, 2, 3}), {2, 2, 200, 160, 8});
  EXPECT_EQ(torn.error(), "of its 2 x 3 cameras those of the 2 x 2 views form no grid");
  ViewList named{2, 2, {"a.png", "b.png", "c.png", "d.png"}};
  EXPECT_EQ(rig_of_hci(*read, named, {2, 2, 200, 160, 8}).error(),
            "it has 2 x 3 cameras, but there are 2 x 2 views");
}

TEST(HciParameters, WhatIsWritten) {
  const LightFieldShape shape{2, 3, 200, 160, 8};
  for (const char* focus : {"34.0", "0"}) {
    const auto read = parse_hci_parameters(with(kText, "34.0", focus));
    const auto rig = rig_of_hci(*read, views_of(2, 3, {0, 1, 2, 3, 4, 5}), shape);
    const auto found = hci_parameters_of(*rig, shape);
    ASSERT_TRUE(found) << found.error();
    const auto again = parse_hci_parameters(hci_parameters_text(*found));
    ASSERT_TRUE(again) << again.error();
    EXPECT_EQ(again->grid.rows, 2u);
    EXPECT_EQ(again->grid.cols, 3u);
    EXPECT_EQ(again->width, 200u);
    EXPECT_EQ(again->height, 160u);
    EXPECT_EQ(again->sensor_size_mm, 35);
    EXPECT_NEAR(again->focal_length_mm, 70, 1e-9);
    EXPECT_NEAR(again->baseline_mm, 85, 1e-9);
    EXPECT_NEAR(again->focus_distance_m, std::stod(focus), 1e-9);
  }
}

TEST(HciParameters, TheFirstThingThatDoesNotFit) {
  const LightFieldShape shape{2, 3, 200, 160, 8};
  const Rig good =
      *rig_of_hci(*parse_hci_parameters(kText), views_of(2, 3, {0, 1, 2, 3, 4, 5}), shape);
  const auto refusal = [&](const auto& change) {
    Rig rig = good;
    change(rig);
    const auto found = hci_parameters_of(rig, shape);
    return found ? std::string("fits") : found.error();
  };
  EXPECT_EQ(refusal([](Rig&) {}), "fits");
  EXPECT_EQ(refusal([](Rig& rig) { rig.rotations = {{1, 0, 0, 0}}; }), "fits");
  EXPECT_EQ(refusal([](Rig& rig) {
              rig.rotations = {{0, 1, 0, 0}};
            }),
            "rotations[0] turns a camera");
  EXPECT_EQ(refusal([](Rig& rig) { rig.intrinsics.clear(); }),
            "the rig does not know the intrinsics");
  const std::string grid = "does not stand on a square grid in a plane";
  EXPECT_EQ(refusal([](Rig& rig) { rig.positions[4][1] += 0.001; }),
            "the camera of view 1,1 " + grid);
  EXPECT_EQ(refusal([](Rig& rig) { rig.positions[2][2] = 1; }), "the camera of view 0,2 " + grid);
  EXPECT_EQ(refusal([](Rig& rig) {
              for (auto& position : rig.positions) position[0] = -position[0];
            }),
            "the cameras do not go to the right and down");
  EXPECT_EQ(refusal([](Rig& rig) { rig.intrinsics[3][0] = 401; }),
            "the camera of view 1,0 has another focal length than the first, or two");
  EXPECT_EQ(refusal([](Rig& rig) { rig.intrinsics[1][3] += 0.1; }),
            "the camera of view 0,1 has a principal point that no distance of focus gives");
}

TEST(HciParameters, MalformedFiles) {
  const auto refusal = [](const std::string& text) {
    const auto read = parse_hci_parameters(text);
    return read ? std::string("fits") : read.error();
  };
  EXPECT_EQ(refusal(kText), "fits");
  EXPECT_EQ(refusal("; a comment\n# another\r\n" + kText), "fits");
  EXPECT_EQ(refusal(with(kText, "baseline_mm = 85.0", "baseline_mm: 85.0\r")), "fits");
  EXPECT_EQ(refusal(""), "intrinsics.focal_length_mm is missing");
  EXPECT_EQ(refusal(with(kText, "[extrinsics]", "[meta]")), "extrinsics.num_cams_x is missing");
  EXPECT_EQ(refusal("focal_length_mm = 100"), "line 1 is no [SECTION] and, in one, no KEY = VALUE");
  EXPECT_EQ(refusal(with(kText, "fstop = 100.0", "fstop")),
            "line 6 is no [SECTION] and, in one, no KEY = VALUE");
  EXPECT_EQ(refusal(with(kText, "fstop = 100.0", "sensor_size_mm = 50.0")),
            "line 6: intrinsics.sensor_size_mm is there twice");
  EXPECT_EQ(refusal(with(kText, "85.0", "8,5")),
            "extrinsics.baseline_mm is \"8,5\"; it must be a number");
  EXPECT_EQ(refusal(with(kText, "85.0", "")),
            "extrinsics.baseline_mm is \"\"; it must be a number");
  EXPECT_EQ(refusal(with(kText, "85.0", "nan")),
            "extrinsics.baseline_mm is nan; it must lie in [1e-06, 1000000]");
  EXPECT_EQ(refusal(with(kText, "50.0", "0")),
            "intrinsics.sensor_size_mm is 0; it must lie in [1e-06, 1000000]");
  EXPECT_EQ(refusal(with(kText, "34.0", "-1")),
            "extrinsics.focus_distance_m is -1; it must lie in [0, 1000000]");
  EXPECT_EQ(refusal(with(kText, "num_cams_x = 3", "num_cams_x = 1e9")),
            "extrinsics.num_cams_x is 1e9; it must lie in [1, 4096]");
  EXPECT_EQ(refusal(with(kText, "num_cams_y = 2", "num_cams_y = 2.5")),
            "extrinsics.num_cams_y must be an integer");
}

}  // namespace
}  // namespace hmlfc::io
