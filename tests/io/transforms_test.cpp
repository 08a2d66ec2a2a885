// transforms.json: axes, intrinsics and which frame is whose, against their definitions.
#include "io/transforms.hpp"

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hmlfc::io {
namespace {

using Json = nlohmann::json;
using Rows = std::array<std::array<double, 3>, 3>;

const CameraPictures kPictures{{"a", "b"}, 400, 300};

Json frame(const std::string& path, Json matrix = {{1, 0, 0, 5}, {0, 1, 0, 6}, {0, 0, 1, 7}}) {
  return {{"file_path", path}, {"transform_matrix", std::move(matrix)}};
}

Json two_frames() { return {{"frames", {frame("./images/b.png"), frame("images/a")}}}; }

std::string fault_of(const Json& json) {
  const auto rig = rig_of_transforms(json, kPictures);
  return rig ? "ok" : rig.error();
}

// The matrix of a quaternion of length 1.
Rows rows_of(const std::array<double, 4>& q) {
  const auto [w, x, y, z] = q;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

// A camera whose picture is upright looks along -Z of an OpenGL world: X stays, Y and Z are turned.
TEST(Transforms, AxesByHand) {
  const auto rig = rig_of_transforms(two_frames(), kPictures);
  ASSERT_TRUE(rig) << rig.error();
  EXPECT_EQ(*rig, (Rig{{}, {{5, 6, 7}, {5, 6, 7}}, {{0, 1, 0, 0}}, {}}));
}

TEST(Transforms, RotationsByTheirMatrix) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int turn = 0; turn < 1000; ++turn) {
    std::array<double, 4> q{normal(random), normal(random), normal(random), normal(random)};
    if (turn % 4 == 0) q[static_cast<size_t>(turn / 4 % 4)] = 0;
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (double& part : q) part /= length;
    const Rows world = rows_of(q);  // of OpenGL's axes
    Json matrix = Json::array();
    for (const auto& row : world) matrix.push_back({row[0], row[1], row[2], 0.0});
    matrix.push_back({0, 0, 0, 1});
    const Json json{{"frames", {frame("a", matrix), frame("b", matrix)}}};
    const auto rig = rig_of_transforms(json, kPictures);
    ASSERT_TRUE(rig) << rig.error();
    ASSERT_EQ(rig->rotations.size(), 1u);
    EXPECT_GE(rig->rotations[0][0], 0);
    const Rows ours = rows_of(rig->rotations[0]);
    for (size_t r = 0; r < 3; ++r) {
      EXPECT_NEAR(ours[r][0], world[r][0], 1e-12);
      EXPECT_NEAR(ours[r][1], -world[r][1], 1e-12);
      EXPECT_NEAR(ours[r][2], -world[r][2], 1e-12);
    }
  }
}

TEST(Transforms, Intrinsics) {
  const auto of = [](const Json& members) {
    Json json = two_frames();
    json.update(members);
    return rig_of_transforms(json, kPictures).value().intrinsics;
  };
  using Entries = std::vector<std::array<double, 4>>;
  EXPECT_EQ(of(Json::object()), Entries{});
  EXPECT_EQ(of({{"fl_x", 500}}), (Entries{{500, 500, 199.5, 149.5}}));
  EXPECT_EQ(of({{"fl_x", 500}, {"fl_y", 510}, {"cx", 210}, {"cy", 140}}),
            (Entries{{500, 510, 209.5, 139.5}}));
  // Pictures of half the size that the file states.
  EXPECT_EQ(of({{"fl_x", 500}, {"w", 800}, {"h", 600}, {"cx", 420}, {"k1", 0}}),
            (Entries{{250, 250, 209.5, 149.5}}));
  // One side tells the other; sides of smaller copies are rounded.
  EXPECT_EQ(of({{"fl_x", 500}, {"h", 600}}), (Entries{{250, 250, 199.5, 149.5}}));
  EXPECT_NEAR(of({{"fl_y", 500}, {"w", 1603}, {"h", 1201}})[0][1], 500 * 300.0 / 1201, 1e-9);
  // 90 degrees: the focal length is half the width, or the height.
  for (const Json& angle : {Json{{"camera_angle_x", std::acos(-1) / 2}}, {{"x_fov", 90}}}) {
    EXPECT_NEAR(of(angle)[0][0], 200, 1e-9);
    EXPECT_NEAR(of(angle)[0][1], 200, 1e-9);
  }
  EXPECT_NEAR(of({{"x_fov", 90}, {"y_fov", 90}})[0][1], 150, 1e-9);
  Json json = two_frames();
  json["fl_x"] = 500;
  json["frames"][1]["fl_x"] = 600;  // of the first picture
  EXPECT_EQ(rig_of_transforms(json, kPictures).value().intrinsics,
            (Entries{{600, 600, 199.5, 149.5}, {500, 500, 199.5, 149.5}}));
  json["frames"][1].erase("fl_x");
  json["frames"][1]["x_fov"] = 90;  // before the file's fl_x
  EXPECT_NEAR(rig_of_transforms(json, kPictures).value().intrinsics[0][0], 200, 1e-9);
}

// Folders of Windows, and rows of float32.
TEST(Transforms, FilesOfOtherPrograms) {
  Json json = two_frames();
  json["frames"][0]["file_path"] = ".\\images\\b.png";
  for (Json& frame : json["frames"]) {
    frame["transform_matrix"].push_back({0, 0, 1e-9, 0.99999994});
  }
  json.update(
      Json::parse(R"({"camera_model": "OPENCV", "k1": 0, "is_fisheye": false, "ortho": "false",
      "distortion_params": [0, 0.0], "is_undistorted": true, "aabb_scale": 16, "fl_x": 500, "K": 1})"));
  const auto rig = rig_of_transforms(json, kPictures);
  ASSERT_TRUE(rig) << rig.error();
  EXPECT_EQ(rig->positions.size(), 2u);
  json["frames"][0]["file_path"] = "row1\\a.png";
  json["frames"][1]["file_path"] = "views/row0/a";
  json["frames"][1]["transform_matrix"][0][3] = -5;
  const auto folders = rig_of_transforms(json, {{"row0/a", "row1/a"}, 400, 300});
  ASSERT_TRUE(folders) << folders.error();
  EXPECT_EQ(folders->positions[0][0], -5);
}

template <class Change>
std::string changed(const Change& change) {
  Json json = two_frames();
  change(json);
  return fault_of(json);
}

// Of the file or of a frame that is used.
TEST(Transforms, LensesThatAreNoPinholes) {
  for (const Json& lens :
       Json::parse(R"([{"k1": 0.25}, {"p2": -1e-3}, {"k6": 1}, {"is_fisheye": true},
           {"is_fisheye": 1}, {"is_fisheye": "true"}, {"camera_model": "OPENCV_FISHEYE"},
           {"camera_model": "EQUIRECTANGULAR"}, {"camera_model": "fov"}, {"camera_model": 3},
           {"camera_type": "orthographic"}, {"ftheta_p1": 1}, {"latlong": true},
           {"distortion_params": [0, 0.1]}, {"rolling_shutter": [0, 0, 1]}, {"from_mitsuba": true}])")) {
    const std::string name = lens.begin().key();
    EXPECT_EQ(changed([&](Json& j) { j.update(lens); }).find(name + " is "), 0u) << name;
    const auto in_frame = changed([&](Json& j) { j["frames"][1].update(lens); });
    EXPECT_EQ(in_frame.find("frames[1]." + name + " is "), 0u) << in_frame;
    EXPECT_EQ(
        changed([&](Json& j) { j["frames"].push_back(frame("c")), j["frames"][2].update(lens); }),
        "ok");
  }
}

TEST(Transforms, WhatIsWrongIsNamed) {
  EXPECT_EQ(changed([](Json& j) { j["frames"] = 1; }), "frames must be an array");
  EXPECT_EQ(changed([](Json& j) { j["frames"].erase(0); }),
            "frames: no file_path names the view b");
  EXPECT_EQ(changed([](Json& j) { j["frames"].push_back(frame("x/a.jpg")); }),
            "frames[1] and frames[2] both name a");
  EXPECT_EQ(changed([](Json& j) { j["frames"].push_back(frame("other.jpg")); }), "ok");
  EXPECT_EQ(changed([](Json& j) { j["frames"][0].erase("file_path"); }),
            "frames[0].file_path must be a text");
  EXPECT_EQ(changed([](Json& j) { j["frames"][0].erase("transform_matrix"); }),
            "frames[0].transform_matrix must be 3 or 4 rows of 4 numbers");
  EXPECT_EQ(changed([](Json& j) { j["frames"][0]["transform_matrix"][2][3] = "x"; }),
            "frames[0].transform_matrix[2] must be 4 numbers");
  EXPECT_EQ(changed([](Json& j) {
              j["frames"][0]["transform_matrix"].push_back({0, 0, 0, 2});
            }),
            "frames[0].transform_matrix[3] must be 0, 0, 0, 1");
  const std::string no_rotation =
      "frames[1].transform_matrix does not turn: its columns must have the length 1 and be at "
      "right "
      "angles, without a mirror";
  EXPECT_EQ(changed([](Json& j) { j["frames"][1]["transform_matrix"][0][0] = -1; }), no_rotation);
  EXPECT_EQ(changed([](Json& j) { j["frames"][1]["transform_matrix"][0][0] = 1.01; }), no_rotation);
  EXPECT_EQ(
      changed([](Json& j) { j["frames"][1]["is_fisheye"] = true; }),
      "frames[1].is_fisheye is true: the cameras of a rig are pinholes; undistort the pictures "
      "and leave it out");
  EXPECT_EQ(changed([](Json& j) { j["camera_angle_x"] = 50; }),
            "camera_angle_x is 50, outside (0, pi) radians; if these are degrees, call it x_fov");
  EXPECT_EQ(changed([](Json& j) { j["frames"][0]["y_fov"] = 180; }),
            "frames[0].y_fov is 180, outside (0, 180) degrees");
  EXPECT_EQ(
      changed([](Json& j) { j["fovX"] = 50; }),
      "\"fovX\" is not read: say fl_x in pixels, camera_angle_x in radians or x_fov in degrees");
  EXPECT_EQ(changed([](Json& j) { j["w"] = 300, j["h"] = 400; }),
            "frames[1]: w and h are 300 x 400, the pictures 400 x 300: another aspect; were they "
            "turned (EXIF)?");
  EXPECT_NE(changed([](Json& j) { j["w"] = 800, j["h"] = 610; }).find("were they cut?"),
            std::string::npos);
  EXPECT_EQ(
      changed([](Json& j) { j["frames"][1]["fl_x"] = 500; }),
      "frames[0] has no focal length, as fl_x, but frames[1] has one; give it to each, to the "
      "file or to none");
  EXPECT_EQ(changed([](Json& j) { j["frames"][1]["cx"] = "x"; }),
            "frames[1].cx is \"x\"; it must be a number");
  EXPECT_EQ(changed([](Json& j) { j["fl_x"] = nullptr; }), "fl_x is null; it must be a number");
  EXPECT_EQ(changed([](Json& j) { j["fl_x"] = 1, j["w"] = 0; }), "w and h must be at least 1");
}

}  // namespace
}  // namespace hmlfc::io
