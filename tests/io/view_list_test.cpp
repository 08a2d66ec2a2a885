// Which files a folder's views are, and the sentences for those that are not as they should be.
#include "io/view_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "io/temp_folder.hpp"

namespace hmlfc::io {
namespace {

using Strings = std::vector<std::string>;

// "ROWSxCOLS: names" of the views in `folder`, or the error, which names the folder.
std::string list(const std::filesystem::path& folder, std::optional<GridShape> grid) {
  const auto views = list_views(folder, grid);
  if (!views) {
    EXPECT_NE(views.error().message.find(folder.string()), std::string::npos);
    return views.error().message;
  }
  std::string text = std::to_string(views->rows) + "x" + std::to_string(views->cols) + ":";
  for (const auto& file : views->files) {
    EXPECT_EQ(file.parent_path(), folder);
    text += " " + file.filename().string();
  }
  return text;
}

// Empty files, and what list() says of a folder of them: a text with all of `parts`.
struct Listed {
  Strings files;
  std::optional<GridShape> grid;
  Strings parts;
};

void expect_lists(const std::vector<Listed>& cases) {
  for (const Listed& c : cases) {
    const test::TempFolder folder;
    for (const std::string& name : c.files) test::put_file(folder / name, std::string());
    const std::string text = list(folder.path(), c.grid);
    for (const std::string& part : c.parts) {
      EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
    }
  }
}

// Names out_RR_CC.png of a grid without those of `missing`, and `more` names.
Strings names_of(uint32_t rows, uint32_t cols, const Strings& missing = {}, Strings more = {}) {
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t col = 0; col < cols; ++col) {
      const std::string name = "out_0" + std::to_string(row) + "_0" + std::to_string(col) + ".png";
      if (std::ranges::find(missing, name) == missing.end()) more.push_back(name);
    }
  }
  return more;
}

// Names input_CamNNN.png of cameras 0 to 8 without 4, and `more` names.
Strings cameras_but_4(Strings more = {}) {
  for (const char* number : {"0", "1", "2", "3", "5", "6", "7", "8"}) {
    more.push_back(std::string("input_Cam00") + number + ".png");
  }
  return more;
}

TEST(ViewList, RowsAndColumnsOfNames) {
  const std::string two =
      "2x3: out_00_00.png out_00_01.png out_00_02.png out_01_00.png out_01_01.png out_01_02.png";
  const Strings part{"v_2_3.png", "v_2_5.png", "v_2_9.png", "v_6_3.png", "v_6_5.png", "v_6_9.png"};
  expect_lists({
      {names_of(2, 3), {}, {two}},
      {names_of(2, 3), GridShape{2, 3}, {two}},
      {{"out_00_00_-381.909271_1103.376221.jpg", "out_00_01_-382.67_1095_.JPG",
        "out_01_00_7_-9.5_.jpeg", "out_01_01_7_9.ppm"},
       {},
       {"2x2: out_00_00_-381.909271_1103.376221.jpg out_00_01_-382.67_1095_.JPG "
        "out_01_00_7_-9.5_.jpeg out_01_01_7_9.ppm"}},
      {{"v_0_9.png", "v_0_10.png", "v_0_00.png", "v_0_01.png", "v_0_02.png", "v_0_03.png",
        "v_0_04.png", "v_0_05.png", "v_0_06.png", "v_0_07.png", "v_0_08.png"},
       {},
       {"1x11: v_0_00.png v", "v_0_9.png v_0_10.png"}},
      {names_of(1, 1, {}, {"LICENSE.txt", "a.png.partial-77", ".hidden.png", "depth.pfm", "none"}),
       {},
       {"1x1: out_00_00.png"}},
      {{"0_0.png", "0_1.ppm", "0_2.pgm", "0_3.pnm", "0_4.jpg", "0_5.jpeg", "0_6.PNG", "0_7.jfif"},
       {},
       {"1x8: 0_0.png 0_1.ppm 0_2.pgm 0_3.pnm 0_4.jpg 0_5.jpeg 0_6.PNG 0_7.jfif"}},
      {{"0_0.jpe", "0_1.tif", "0_2.TIFF", "0_3.webp"},
       {},
       {"1x4: 0_0.jpe 0_1.tif 0_2.TIFF 0_3.webp"}},
      // A grid of the right size takes a subset.
      {part, GridShape{2, 3}, {"2x3: v_2_3.png v_2_5.png v_2_9.png v_6_3.png v_6_5.png v_6_9.png"}},
      {part, GridShape{3, 2}, {"extra view v_2_3.png"}},
      {{"v_2_3.png", "v_2_5.png", "v_2_9.png", "v_6_3.png", "v_6_9.png"},
       GridShape{2, 3},
       {"1 of the 6 views", "row 1, column 1"}},
  });
}

TEST(ViewList, MissingDoubleAndExtraViews) {
  const Strings gap{"out_02_03.png"};
  const Strings four{"out_00_00.png", "out_01_04.png", "out_03_00.png", "out_03_01.png"};
  expect_lists({
      {names_of(4, 5, gap), {}, {"1 of the 20 views of a 4x5 grid is missing: row 2, column 3"}},
      {names_of(4, 5, gap), GridShape{4, 5}, {"row 2, column 3"}},
      {names_of(4, 5, four),
       {},
       {"4 of the 20 views", "row 0, column 0, row 1, column 4, row 3, column 0 ..."}},
      // Two far corners do not cost memory.
      {{"0_0.png", "4095_4095.png"}, {}, {"16777214 of the 16777216 views", "row 0, column 1"}},
      {names_of(3, 3, {}, {"out_1_2.png"}),
       {},
       {"row 1, column 2 is there twice", "out_01_02.png", "out_1_2.png"}},
      {names_of(3, 3, {}, {"out_01_02.jpg"}), {}, {"is there twice", "out_01_02.jpg"}},
      {names_of(3, 3, {}, {"thumbnail.jpg"}), {}, {"extra picture thumbnail.jpg"}},
      {names_of(3, 4), GridShape{3, 3}, {"extra view out_00_03.png", "row 0, column 3", "3 rows"}},
      {names_of(3, 4), GridShape{4, 4}, {"4 of the 16 views of a 4x4 grid", "row 3, column 0"}},
      {names_of(3, 4), GridShape{4, 3}, {"extra view out_00_03.png"}},
  });
}

TEST(ViewList, CameraNumbers) {
  const std::string files = " input_Cam000.png input_Cam001.png input_Cam002.png input_Cam003.png";
  const Strings four{"input_Cam000.png", "input_Cam001.png", "input_Cam002.png",
                     "input_Cam003.png"};
  const Strings two{"input_Cam0.png", "input_Cam1.png"};
  const Strings part{"input_Cam010.png", "input_Cam012.png", "input_Cam030.png", "input_Cam9.png"};
  expect_lists({
      {four, {}, {"2x2:" + files}},
      {four, GridShape{1, 4}, {"1x4:" + files}},
      {two, {}, {"--grid", "input_Cam1"}},
      {two, GridShape{1, 2}, {"1x2:"}},
      {part,
       GridShape{2, 2},
       {"2x2: input_Cam9.png input_Cam010.png input_Cam012.png input_Cam030.png"}},
      {part, GridShape{1, 3}, {"extra view"}},
      {cameras_but_4(), {}, {"1 of the 9 views", "row 1, column 1"}},
      {cameras_but_4({"input_Cam004.png", "input_Cam4.png"}),
       {},
       {"row 1, column 1 is there twice", "input_Cam004.png"}},
      {cameras_but_4({"input_Cam004.png"}),
       GridShape{2, 4},
       {"extra view input_Cam008.png", "row 2, column 0"}},
      {cameras_but_4({"input_Cam004.png", "mask.png"}), {}, {"extra picture mask.png"}},
  });
}

TEST(ViewList, OtherNamesInTheirOrder) {
  const Strings six{"pic10.png", "pic2.png", "pic1.png", "pic9.png", "pic11.png", "pic3.jpg"};
  const GridShape two{2, 2};
  expect_lists({
      {six, GridShape{2, 3}, {"2x3: pic1.png pic2.png pic3.jpg pic9.png pic10.png pic11.png"}},
      {six, {}, {"--grid", "pic1.png"}},
      {{"a01.png", "a02.png", "a04.png"},
       two,
       {"3 pictures for a 2x2 grid of 4", "between a02.png and a04.png", "row 1, column 0"}},
      {{"a01.png", "a02.png", "a03.png"},
       two,
       {"after a03.png the view of row 1, column 1 is missing"}},
      {{"a1.png", "a2.png", "a3.png", "a4.png", "a5.png"},
       two,
       {"5 pictures for a 2x2 grid of 4", "a5.png is the first one"}},
      {{"a1.png", "a2.png", "a02.png", "a3.png"}, two, {"twice", "a2.png", "a02.png"}},
  });
}

TEST(ViewList, WhatIsNoFolderOfViews) {
  expect_lists({{{}, {}, {"no PNG, JPEG, TIFF, WebP, PPM or PGM"}},
                {{"0_0.png"}, GridShape{0, 1}, {"1 to 4096"}},
                {{"0_0.png"}, GridShape{1, 4097}, {"1 to 4096"}}});
  const test::TempFolder folder;
  test::put_file(folder / "file.png", std::string());
  EXPECT_NE(list(folder / "file.png", {}).find("not a folder"), std::string::npos);
  EXPECT_FALSE(list_views(folder / "absent").has_value());
  std::filesystem::create_directory(folder / "02_02.png");
  EXPECT_NE(list(folder.path(), {}).find("--grid"), std::string::npos) << "a folder is no picture";
}

}  // namespace
}  // namespace hmlfc::io
