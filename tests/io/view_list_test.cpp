// Which files a folder's views are, and the sentences for those that are not as they should be.
#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "io/temp_folder.hpp"
#include "io/view_list.hpp"
#include "io/view_name.hpp"

namespace hmlfc::io {
namespace {

using NameList = std::vector<std::string>;

class ViewListTest : public testing::Test {
 protected:
  void touch(const NameList& names) {
    for (const std::string& name : names) test::put_file(folder_ / name, std::string());
  }
  void touch_grid(uint32_t rows, uint32_t cols, const std::string& prefix = "out_") {
    for (uint32_t row = 0; row < rows; ++row) {
      for (uint32_t col = 0; col < cols; ++col) {
        touch({prefix + view_stem(row, col, rows, cols) + ".png"});
      }
    }
  }
  void remove(const std::string& name) { std::filesystem::remove(folder_ / name); }

  /// "ROWSxCOLS: names", or the error.
  std::string list(std::optional<GridShape> grid = std::nullopt) {
    const auto views = list_views(folder_.path(), grid);
    if (!views) return views.error().message;
    std::string text = std::to_string(views->rows) + "x" + std::to_string(views->cols) + ":";
    for (const auto& file : views->files) {
      EXPECT_EQ(file.parent_path(), folder_.path());
      text += ' ';
      text += file.filename().string();
    }
    return text;
  }
  void expect_error(std::optional<GridShape> grid, std::initializer_list<const char*> parts) {
    const auto views = list_views(folder_.path(), grid);
    ASSERT_FALSE(views.has_value());
    EXPECT_NE(views.error().message.find(folder_.path().string()), std::string::npos);
    for (const char* part : parts) {
      EXPECT_NE(views.error().message.find(part), std::string::npos)
          << "'" << part << "' is not in: " << views.error().message;
    }
  }

  test::TempFolder folder_;
};

TEST_F(ViewListTest, ReadsRowAndColumnFromNames) {
  touch({"out_00_00.png", "out_00_01.png", "out_00_02.png", "out_01_00.png", "out_01_01.png",
         "out_01_02.png"});
  const std::string expected =
      "2x3: out_00_00.png out_00_01.png out_00_02.png out_01_00.png out_01_01.png out_01_02.png";
  EXPECT_EQ(list(), expected);
  EXPECT_EQ(list(GridShape{2, 3}), expected);
}

TEST_F(ViewListTest, ReadsTheStanfordArchivesNames) {
  touch({"out_00_00_-381.909271_1103.376221.jpg", "out_00_01_-382.67_1095_.JPG",
         "out_01_00_7_-9.5_.jpeg", "out_01_01_7_9.ppm"});
  EXPECT_EQ(list(),
            "2x2: out_00_00_-381.909271_1103.376221.jpg out_00_01_-382.67_1095_.JPG "
            "out_01_00_7_-9.5_.jpeg out_01_01_7_9.ppm");
}

TEST_F(ViewListTest, PadsNeedNotBeEqual) {
  touch({"v_0_9.png", "v_0_10.png"});
  for (int col = 0; col < 9; ++col) touch({"v_0_0" + std::to_string(col) + ".png"});
  EXPECT_EQ(list().substr(0, 18), "1x11: v_0_00.png v");
  EXPECT_NE(list().find("v_0_9.png v_0_10.png"), std::string::npos);
}

TEST_F(ViewListTest, IgnoresWhatIsNoPicture) {
  touch_grid(2, 2, "");
  touch({"LICENSE.txt", "parameters.json", "00_02.png.partial-77", ".hidden.png", "depth.pfm",
         "noextension"});
  std::filesystem::create_directory(folder_ / "02_02.png");
  EXPECT_EQ(list(), "2x2: 00_00.png 00_01.png 01_00.png 01_01.png");
}

TEST_F(ViewListTest, AcceptsEveryExtension) {
  touch({"0_0.png", "0_1.ppm", "0_2.pgm", "0_3.pnm", "0_4.jpg", "0_5.jpeg", "0_6.PNG"});
  EXPECT_EQ(list(), "1x7: 0_0.png 0_1.ppm 0_2.pgm 0_3.pnm 0_4.jpg 0_5.jpeg 0_6.PNG");
}

TEST_F(ViewListTest, NamesAMissingView) {
  touch_grid(4, 5);
  remove("out_02_03.png");
  expect_error(std::nullopt, {"1 of the 20 views of a 4x5 grid is missing: row 2, column 3"});
  expect_error(GridShape{4, 5}, {"row 2, column 3"});
}

TEST_F(ViewListTest, NamesTheFirstOfManyMissingViews) {
  touch_grid(4, 5);
  for (const char* name : {"out_00_00.png", "out_01_04.png", "out_03_00.png", "out_03_01.png"}) {
    remove(name);
  }
  expect_error(std::nullopt, {"4 of the 20 views",
                              "row 0, column 0, row 1, column 4, row 3, "
                              "column 0 ..."});
}

TEST_F(ViewListTest, TwoFarCornersDoNotCostMemory) {
  touch({"0_0.png", "4095_4095.png"});
  expect_error(std::nullopt, {"16777214 of the 16777216 views", "row 0, column 1"});
}

TEST_F(ViewListTest, NamesADoubleView) {
  touch_grid(3, 3);
  touch({"out_1_2.png"});
  expect_error(std::nullopt, {"row 1, column 2 is there twice", "out_01_02.png", "out_1_2.png"});
  remove("out_1_2.png");
  touch({"out_01_02.jpg"});
  expect_error(std::nullopt, {"row 1, column 2 is there twice", "out_01_02.png", "out_01_02.jpg"});
}

TEST_F(ViewListTest, NamesAnExtraPicture) {
  touch_grid(3, 3);
  touch({"thumbnail.jpg"});
  expect_error(std::nullopt, {"extra picture thumbnail.jpg"});
}

TEST_F(ViewListTest, AGridThatDisagreesWithTheNamesIsAnError) {
  touch_grid(3, 4);
  expect_error(GridShape{3, 3}, {"extra view out_00_03.png", "row 0, column 3", "3 rows and 3"});
  expect_error(GridShape{4, 4}, {"4 of the 16 views of a 4x4 grid are missing", "row 3, column 0"});
  expect_error(GridShape{4, 3}, {"extra view out_00_03.png"});
}

TEST_F(ViewListTest, ReadsCameraNumbersAsASquareOrTheGridAskedFor) {
  touch({"input_Cam000.png", "input_Cam001.png", "input_Cam002.png", "input_Cam003.png"});
  const std::string files = " input_Cam000.png input_Cam001.png input_Cam002.png input_Cam003.png";
  EXPECT_EQ(list(), "2x2:" + files);
  EXPECT_EQ(list(GridShape{1, 4}), "1x4:" + files);
  EXPECT_EQ(list(GridShape{4, 1}), "4x1:" + files);
}

TEST_F(ViewListTest, CameraNumbersThatAreNoSquareNeedAGrid) {
  touch({"input_Cam0.png", "input_Cam1.png", "input_Cam2.png", "input_Cam3.png", "input_Cam4.png",
         "input_Cam5.png"});
  expect_error(std::nullopt, {"--grid", "input_Cam5"});
  EXPECT_EQ(list(GridShape{2, 3}).substr(0, 4), "2x3:");
}

TEST_F(ViewListTest, NamesAMissingDoubleOrExtraCamera) {
  for (int i = 0; i < 9; ++i) touch({"input_Cam00" + std::to_string(i) + ".png"});
  remove("input_Cam004.png");
  expect_error(std::nullopt, {"1 of the 9 views", "row 1, column 1"});
  touch({"input_Cam004.png", "input_Cam4.png"});
  expect_error(std::nullopt, {"row 1, column 1 is there twice", "input_Cam004.png"});
  remove("input_Cam4.png");
  expect_error(GridShape{2, 4}, {"extra view input_Cam008.png", "row 2, column 0"});
  touch({"mask.png"});
  expect_error(std::nullopt, {"extra picture mask.png"});
}

TEST_F(ViewListTest, AGridOfTheRightSizeTakesASubset) {
  touch({"v_2_3.png", "v_2_5.png", "v_2_9.png", "v_6_3.png", "v_6_5.png", "v_6_9.png"});
  EXPECT_EQ(list(GridShape{2, 3}),
            "2x3: v_2_3.png v_2_5.png v_2_9.png v_6_3.png v_6_5.png v_6_9.png");
  expect_error(GridShape{3, 2}, {"extra view v_2_3.png"});
  remove("v_6_5.png");
  expect_error(GridShape{2, 3}, {"1 of the 6 views", "row 1, column 1"});
}

TEST_F(ViewListTest, AGridOfTheRightSizeTakesASubsetOfCameras) {
  touch({"input_Cam010.png", "input_Cam012.png", "input_Cam030.png", "input_Cam9.png"});
  EXPECT_EQ(list(GridShape{2, 2}),
            "2x2: input_Cam9.png input_Cam010.png input_Cam012.png input_Cam030.png");
  touch({"input_Cam31.png"});
  expect_error(GridShape{2, 2}, {"extra view"});
}

TEST_F(ViewListTest, OtherNamesAreTakenInNaturalOrderWithAGrid) {
  touch({"pic10.png", "pic2.png", "pic1.png", "pic9.png", "pic11.png", "pic3.jpg"});
  EXPECT_EQ(list(GridShape{2, 3}), "2x3: pic1.png pic2.png pic3.jpg pic9.png pic10.png pic11.png");
  expect_error(std::nullopt, {"--grid", "pic1.png"});
}

TEST_F(ViewListTest, NamesTheGapInANumberedList) {
  touch({"a01.png", "a02.png", "a04.png"});
  expect_error(GridShape{2, 2}, {"3 pictures for a 2x2 grid of 4", "between a02.png and a04.png",
                                 "row 1, column 0"});
}

TEST_F(ViewListTest, NamesTheEndOfAListThatIsTooShort) {
  touch({"a01.png", "a02.png", "a03.png"});
  expect_error(GridShape{2, 2}, {"after a03.png the view of row 1, column 1 is missing"});
}

TEST_F(ViewListTest, NamesTheFirstPictureTooMany) {
  touch({"a1.png", "a2.png", "a3.png", "a4.png", "a5.png"});
  expect_error(GridShape{2, 2}, {"5 pictures for a 2x2 grid of 4", "a5.png is the first one"});
}

TEST_F(ViewListTest, NamesADoubleNumberInAList) {
  touch({"a1.png", "a2.png", "a02.png", "a3.png"});
  expect_error(GridShape{2, 2}, {"twice", "a2.png", "a02.png", "row 0, column 1"});
}

TEST_F(ViewListTest, RefusesFoldersWithoutPicturesAndWhatIsNoFolder) {
  expect_error(std::nullopt, {"no PNG, PPM, PGM or JPEG"});
  touch({"file.png"});
  const auto views = list_views(folder_ / "file.png");
  ASSERT_FALSE(views.has_value());
  EXPECT_NE(views.error().message.find("not a folder"), std::string::npos);
  EXPECT_FALSE(list_views(folder_ / "absent").has_value());
}

TEST_F(ViewListTest, RefusesGridsOutOfRange) {
  touch({"0_0.png"});
  for (const GridShape grid : {GridShape{0, 1}, {1, 0}, {4097, 1}, {1, 4097}}) {
    expect_error(grid, {"1 to 4096"});
  }
}

}  // namespace
}  // namespace hmlfc::io
