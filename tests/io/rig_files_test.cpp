// Rigs of folders: positions in file names, files of either form.
#include "io/rig_files.hpp"

#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "temp_folder.hpp"

namespace hmlfc::io {
namespace {

using test::TempFolder;

ViewList views_named(uint32_t rows, uint32_t cols, std::vector<std::string> names) {
  ViewList views{rows, cols, {}};
  for (const std::string& name : names) views.files.push_back("views/" + name);
  return views;
}

// X falls along the columns, Y grows along the rows: x is -X, y is Y.
TEST(RigFiles, AxesOfNamesFollowTheGrid) {
  const auto rig = rig_of_names(
      views_named(2, 3,
                  {"out_00_00_-9_5.png", "out_00_01_-8.5_4_.png", "out_00_02_-9_3.png",
                   "out_01_00_-1_5.5.png", "out_01_01_-1_4.png", "out_01_02_-1_3.png"}));
  ASSERT_TRUE(rig && *rig);
  EXPECT_EQ(**rig,
            (Rig{{},
                 {{-5, -9, 0}, {-4, -8.5, 0}, {-3, -9, 0}, {-5.5, -1, 0}, {-4, -1, 0}, {-3, -1, 0}},
                 {},
                 {}}));
}

TEST(RigFiles, NamesWithoutPositions) {
  const auto none = rig_of_names(views_named(1, 2, {"out_00_00_7_2.png", "out_00_01.png"}));
  ASSERT_TRUE(none);
  EXPECT_FALSE(*none);
  const auto far =
      rig_of_names(views_named(1, 2, {"out_00_00_7_2.png", "out_00_01_7_9999999.png"}));
  ASSERT_FALSE(far);
  EXPECT_EQ(far.error().message,
            "views: positions[1][0] is 9999999; it must lie in [-1048576, 1048576]");
}

TEST(RigFiles, EitherForm) {
  const TempFolder folder;
  const auto file = folder.path() / "rig.json";
  const auto views = views_named(1, 2, {"a.png", "b.png"});
  const LightFieldShape shape{1, 2, 40, 30, 8};
  const auto message = [&](const std::string& text) {
    std::ofstream(file) << text;
    const auto rig = read_rig(file, views, shape);
    return rig ? std::to_string(rig->positions[1][0]) : rig.error().message;
  };
  const std::string name = file.string() + ": ";
  EXPECT_EQ(message(R"({"schema": 1, "positions": [[0, 0, 0], [4, 0, 0]]})"), "4.000000");
  EXPECT_EQ(message(R"({"schema": 1, "positions": [[0, 0, 0]]})"),
            name + "positions has 1 entries; 2 are needed, one for each view");
  EXPECT_EQ(message(R"({"frames": [[[[[NaN]]]]]})"),
            name + "no JSON text: byte 17, where JSON has no NaN or Infinity");
  const std::string a =
      R"({"file_path": "a", "transform_matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]})";
  const std::string b =
      R"({"file_path": "b", "transform_matrix": [[1,0,0,3],[0,1,0,0],[0,0,1,0]]})";
  EXPECT_EQ(message(R"({"frames": [)" + b + "," + a + "]}"), "3.000000");
  EXPECT_EQ(message(R"({"frames": [)" + a + "]}"), name + "frames: no file_path names the view b");
  EXPECT_EQ(message(R"({"fl_x": 9999999, "frames": [)" + b + "," + a + "]}"),
            name + "intrinsics[0][0] is 9999999; it must lie in [0.0625, 1048576]");
  // One view of three has its place from a rig of all.
  const auto last = *part_of("", views_named(1, 3, {"a", "b", "c"}), {{0, 0}, {2, 2}});
  std::ofstream(file) << R"({"schema": 1, "positions": [[0, 0, 0], [4, 0, 0], [8, 0, 0]]})";
  EXPECT_EQ(read_rig(file, last, shape)->positions, (std::vector{std::array{8.0, 0.0, 0.0}}));
}

}  // namespace
}  // namespace hmlfc::io
