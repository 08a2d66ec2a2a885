// Which files a folder's views are, and the sentences for those that are not as they should be.
#include "io/view_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "io/temp_folder.hpp"

namespace hmlfc::io {
namespace {

using Strings = std::vector<std::string>;

// "ROWSxCOLS: names" of the views in `folder` and its notes, or the error.
std::string list(const std::filesystem::path& folder, const ViewNaming& naming = {}) {
  const auto views = list_views(folder, naming);
  if (!views) {
    EXPECT_NE(views.error().message.find(folder.string()), std::string::npos);
    return views.error().message;
  }
  std::string text = std::to_string(views->rows) + "x" + std::to_string(views->cols) + ":";
  for (const auto& file : views->files) text += " " + file.lexically_relative(folder).string();
  for (const std::string& note : views->notes) text += " | " + note.substr(folder.string().size());
  return text;
}

// Empty files, and what list() says of a folder of them: a text with all of `parts`.
struct Listed {
  Strings files;
  ViewNaming naming;
  Strings parts;
};

void expect_lists(const std::vector<Listed>& cases) {
  for (const Listed& c : cases) {
    const test::TempFolder folder;
    for (const std::string& name : c.files) {
      std::filesystem::create_directories((folder / name).parent_path());
      test::put_file(folder / name, std::string());
    }
    const std::string text = list(folder.path(), c.naming);
    for (const std::string& part : c.parts) {
      EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
    }
    const bool has_note = std::ranges::any_of(
        c.parts, [](const std::string& part) { return part.find(" | ") != part.npos; });
    EXPECT_EQ(text.find(" | ") != text.npos, has_note) << text;
  }
}

ViewNaming shaped(uint32_t rows, uint32_t cols) { return {.grid = GridShape{rows, cols}}; }

ViewNaming names(const std::string& pattern) { return {.pattern = pattern}; }

// Names of a grid by a printf() format of row, column, 3 * row + 30, 400 - column.
Strings formatted(const char* format, uint32_t rows, uint32_t cols, uint32_t first = 0) {
  Strings result;
  char name[100];
  for (uint32_t row = first; row < first + rows; ++row) {
    for (uint32_t col = first; col < first + cols; ++col) {
      std::snprintf(name, sizeof name, format, row, col, 3 * row + 30, 400 - col);
      result.emplace_back(name);
    }
  }
  return result;
}

Strings operator+(Strings a, const Strings& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Names out_RR_CC.png of a grid without those of `missing`, and `more` names.
Strings names_of(uint32_t rows, uint32_t cols, const Strings& missing = {}, Strings more = {}) {
  for (const std::string& name : formatted("out_0%u_0%u.png", rows, cols)) {
    if (std::ranges::find(missing, name) == missing.end()) more.push_back(name);
  }
  return more;
}

// Names input_CamNNN.png of cameras 0 to 8 without 4, and `more` names.
Strings cameras_but_4(const Strings& more = {}) {
  Strings all = formatted("input_Cam00%u.png", 9, 1);
  all.erase(all.begin() + 4);
  return all + more;
}

TEST(ViewList, RowsAndColumnsOfNames) {
  const std::string two =
      "2x3: out_00_00.png out_00_01.png out_00_02.png out_01_00.png out_01_01.png out_01_02.png";
  const Strings part{"v_2_3.png", "v_2_5.png", "v_2_9.png", "v_6_3.png", "v_6_5.png", "v_6_9.png"};
  expect_lists({
      {names_of(2, 3), {}, {two}},
      {names_of(2, 3), shaped(2, 3), {two}},
      {{"v_0_9.png", "v_0_10.png", "v_0_00.png", "v_0_01.png", "v_0_02.png", "v_0_03.png",
        "v_0_04.png", "v_0_05.png", "v_0_06.png", "v_0_07.png", "v_0_08.png"},
       {},
       {"1x11: v_0_00.png v", "v_0_9.png v_0_10.png"}},
      {{"0_0.png", "0_1.ppm", "0_2.pgm", "0_3.pnm", "0_4.jpg", "0_5.JPEG", "0_6.jfif", "0_7.webp"},
       {},
       {"1x8: 0_0.png 0_1.ppm 0_2.pgm 0_3.pnm 0_4.jpg 0_5.JPEG 0_6.jfif 0_7.webp"}},
      {names_of(1, 1, {},
                {"LICENSE.txt", "a.png.partial-77", ".hidden.png", "._00_00.png", "none"}),
       {},
       {"1x1: out_00_00.png"}},
      {{"view-0-x0.png", "view-0-x1.png", "view-1-x0.png", "view-1-x1.png"},
       {},
       {"2x2: view-0-x0"}},
      // Letters before the numbers say which is which.
      {{"x0_y0.png", "x0_y1.png", "x1_y0.png", "x1_y1.png", "x2_y0.png", "x2_y1.png"},
       {},
       {"2x3: x0_y0.png x1_y0.png x2_y0.png x0_y1.png", " | : 2x3 views from numbers 2 and 1 of"}},
      {{"x_0.0_y_0.0.png", "x_0.0_y_0.1.png", "x_0.1_y_0.0.png", "x_0.1_y_0.1.png"},
       {},
       {"2x2: x_0.0_y_0.0.png x_0.1_y_0.0.png", " | : 2x2 views from numbers 4 and 2"}},
      // Names that count from elsewhere, in steps, or from a middle.
      {formatted("%u_%u.png", 2, 2, 1), {}, {"2x2: 1_1.png 1_2.png", " | : 2x2", "rows 1 to 2"}},
      {formatted("lf.%02u.%02u.png", 2, 2), {}, {"2x2: lf.00.00.png lf.00.01.png"}},
      {{"v_-1_2.png", "v_-1_4.png", "v_1_2.png", "v_1_4.png"},
       {},
       {"2x2: v_-1_2.png v_-1_4.png v_1_2.png", "rows -1 to 1 in steps of 2", " | "}},
      // A grid of the right size takes a subset.
      {part,
       shaped(2, 3),
       {"2x3: v_2_3.png v_2_5.png v_2_9.png v_6_3.png v_6_5.png v_6_9.png", " | "}},
      {part, {}, {"2 of the 8 views of a 2x4 grid", "row 0, column 2 (v_2_7.png)", "--grid 2x3"}},
      {part, shaped(3, 2), {"2 of the 8 views", "--grid says 3x2"}},
      {{"v_2_3.png", "v_2_5.png", "v_2_9.png", "v_6_3.png", "v_6_9.png"},
       shaped(2, 3),
       {"1 of the 6 views", "row 1, column 1 (v_6_5.png)"}},
  });
}

TEST(ViewList, NamesWithMoreNumbers) {
  const Strings blender = formatted("Camera_%02u_%02u_400.0_400.0_%u_%u.jpg", 3, 3);
  Strings gap = blender;
  gap.erase(gap.begin() + 4);
  expect_lists({
      {blender,
       {},
       {"3x3: Camera_00_00_400.0_400.0_30_400.jpg Camera_00_01",
        " | : 3x3 views from numbers 1 and 2 of the names; 5 and 6 vary with them"}},
      {gap,
       {},
       {"1 of the 9 views of a 3x3 grid", "row 1, column 1 (Camera_01_01_400.0_400.0_*_*.jpg)"}},
      {blender, names("{row}_{col}"), {"3x3: Camera_00_00"}},
      {{"out_00_00_-381.909271_1103.376221.jpg", "out_00_01_-382.67_1095_.JPG",
        "out_01_00_7_-9.5_.jpeg", "out_01_01_7_9.ppm"},
       {},
       {"2x2: out_00_00_-381.909271_1103.376221.jpg out_00_01_-382.67_1095_.JPG "
        "out_01_00_7_-9.5_.jpeg out_01_01_7_9.ppm",
        " | : 2x2 views from numbers 1 and 2 of the names; 3 and 4 vary with them"}},
      // Numbers that say the same in another order do not make it ambiguous; independent ones do.
      {{"0_0_1_9.png", "0_1_0_9.png", "1_0_1_8.png", "1_1_0_8.png"}, {}, {"2x2: 0_0_1_9", " | "}},
      {{"0_0_0.png", "0_1_1.png", "1_0_1.png", "1_1_0.png"},
       {},
       {"1 and 2 (2x2) or 1 and 3 (2x2)", "--names '{row}_{col}_*' or '{row}_*_{col}'"}},
      {formatted("f0_%u_%u.png", 2, 2) + formatted("f1_%u_%u.png", 2, 2),
       {},
       {"number 1 has 2 values (0 to 1)", "number 3 has 2",
        "--names 'f{row}_{col}_0' or 'f0_{row}_{col}'"}},
      {formatted("f0_%u_%u.png", 2, 2) + formatted("f1_%u_%u.png", 2, 2),
       names("f1_{row}_{col}"),
       {"2x2: f1_0_0.png",
        " | : ignored, for not being named like the 4 views (f1_0_0.png): f0_0_0"}},
  });
}

TEST(ViewList, PatternsOfNames) {
  const Strings pleno{"000_000.ppm", "000_001.ppm", "001_000.ppm", "001_001.ppm"};
  const Strings both = formatted("%u_%u.png", 2, 2) + formatted("%u_%u.jpg", 2, 2);
  expect_lists({
      {pleno, names("{col}_{row}"), {"2x2: 000_000.ppm 001_000.ppm 000_001.ppm 001_001.ppm"}},
      {pleno,
       {},
       {"2x2: 000_000.ppm 000_001.ppm", " | : names are read as ROW_COLUMN", "'{col}_{row}'"}},
      {{"a7b1.png", "a3b2.png"},
       {.grid = GridShape{1, 2}, .pattern = "b{index}"},
       {"1x2: a7b1.png a3b2.png", " | : 1x2 views in the order of number 1 of the names (1 to 2)"}},
      {{"img2_1_2.png", "img2_1_3.png"}, names("*_{row}_{col}"), {"1x2: img2_1_2.png"}},
      {both, {}, {"is there twice, as 0_0.jpg and 0_0.png", "--names '*.png'"}},
      {both,
       names("*.png"),
       {"2x2: 0_0.png 0_1.png", " | : ignored", "0_0.jpg, 0_1.jpg, 1_0.jpg and 1"}},
      {formatted("l_%u_%u.png", 2, 2) + formatted("r_%u_%u.png", 2, 2),
       {},
       {"like l_0_0.png and, as many, like r_0_0.png", "--names 'l_{row}_{col}'"}},
      {pleno,
       names("v{row}_{col}"),
       {"no name is as --names 'v{row}_{col}' says; one is 000_000.ppm"}},
      {pleno,
       {.pattern = "v{row}_{col}", .pattern_is_for_others = true},
       {"2x2: 000_000.ppm 000_001", " | : names are read as ROW_COLUMN"}},
      {pleno, names("{row}_{row}"), {"it has {row} twice"}},
      {pleno, names("{row}_{index}"), {"it has {index}, and {row} or {col}"}},
      {pleno, names("{row}_{colum}"), {"{colum} is no field; there are {row}, {col}"}},
      {pleno, names("{row}"), {"the same row and column in 000_000.ppm and 000_001.ppm"}},
  });
}

TEST(ViewList, MissingDoubleAndExtraViews) {
  const Strings gap{"out_02_03.png"};
  const Strings four{"out_00_00.png", "out_01_04.png", "out_03_00.png", "out_03_01.png"};
  expect_lists({
      {names_of(4, 5, gap),
       {},
       {"1 of the 20 views of a 4x5 grid is missing: row 2, column 3 (out_02_03.png)"}},
      {names_of(4, 5, gap), shaped(4, 5), {"row 2, column 3"}},
      {names_of(4, 5, four),
       {},
       {"4 of the 20 views", "row 0, column 0 (", "row 1, column 4 (", " ..."}},
      // Two far corners do not cost memory.
      {{"0_0.png", "0_4095.png", "4094_0.png", "1_1.png"},
       {},
       {"number 1 has 3 values", "give --grid ROWSxCOLS"}},
      {{"0_0.png", "0_4095.png", "4094_0.png"}, {}, {"row 1, column 1 (4094_4095.png)"}},
      {names_of(3, 3, {}, {"out_1_2.png"}), {}, {"is there twice", "out_01_02.png", "out_1_2.png"}},
      {names_of(3, 3, {}, {"thumbnail.jpg"}),
       {},
       {"3x3: out_00_00.png", " | : ignored", "the 9 views (out_00_00.png): thumbnail.jpg"}},
      {names_of(3, 3, {"out_01_01.png"}, {"thumbnail.jpg"}), {}, {"1 of the 9", "thumbnail.jpg"}},
      {names_of(3, 4), shaped(4, 3), {"a grid of 3x4 views, not 4x3", "--order raster"}},
      {names_of(3, 4),
       {.grid = GridShape{4, 3}, .order = FrameOrder::kRaster},
       {"4x3: out_00_00.png", "out_02_03.png", " | : 4x3 views in the sorted order of the names"}},
  });
}

TEST(ViewList, FoldersOfViews) {
  expect_lists({
      {formatted("row%u/%02u.png", 2, 3) + Strings{"notes/a.txt", ".git/9_9.png"},
       {},
       {"2x3: row0/00.png row0/01.png row0/02.png row1/00.png"}},
      {formatted("rectified/%u_%u.png", 2, 2) + Strings{"preview.png", "__MACOSX/0_0.png"},
       {},
       {"2x2: rectified/0_0.png", " | : ignored", "preview.png"}},
      {formatted("a/%u_%u.png", 2, 2) + formatted("b/%u_%u.png", 2, 2),
       {},
       {"like a/0_0.png and, as many, like b/0_0.png"}},
  });
}

TEST(ViewList, CameraNumbers) {
  const std::string files = " input_Cam000.png input_Cam001.png input_Cam002.png input_Cam003.png";
  const Strings four{"input_Cam000.png", "input_Cam001.png", "input_Cam002.png",
                     "input_Cam003.png"};
  const Strings two{"input_Cam0.png", "input_Cam1.png"};
  const Strings part{"input_Cam010.png", "input_Cam012.png", "input_Cam030.png", "input_Cam9.png"};
  expect_lists({
      {four, {}, {"2x2:" + files, " | "}},
      {four, shaped(1, 4), {"1x4:" + files, " | "}},
      {two, {}, {"--grid", "input_Cam0"}},
      {two, shaped(1, 2), {"1x2:", " | "}},
      {two + Strings{"parameters.cfg"}, {}, {"parameters.cfg: extrinsics.num_cams_x is", "--grid"}},
      {part,
       shaped(2, 2),
       {"2x2: input_Cam9.png input_Cam010.png input_Cam012.png input_Cam030.png", " | "}},
      {part, shaped(1, 3), {"4 pictures for a 1x3 grid", "one too many"}},
      {cameras_but_4(), {}, {"1 is missing: row 1, column 1 (input_Cam004.png)"}},
      {cameras_but_4({"input_Cam004.png", "input_Cam4.png"}),
       {},
       {"is there twice", "input_Cam004.png"}},
      {cameras_but_4({"input_Cam004.png", "mask.png"}), {}, {"3x3: input_Cam000.png", " | "}},
  });
}

TEST(ViewList, SequencesOfPictures) {
  const Strings six{"pic10.png", "pic2.png", "pic1.png", "pic9.png", "pic11.png", "pic3.jpg"};
  const auto ordered = [](FrameOrder order) {
    return ViewNaming{.grid = GridShape{2, 3}, .order = order};
  };
  expect_lists({
      {six,
       shaped(2, 3),
       {"2x3: pic1.png pic2.png pic3.jpg pic9.png pic10.png pic11.png",
        " | : 2x3 views in the order of number 1 of the names (1 to 11 with gaps), "
        "row by row"}},
      {six,
       ordered(FrameOrder::kSerpentine),
       {"2x3: pic1.png pic2.png pic3.jpg pic11.png pic10.png pic9.png", " | "}},
      {six,
       ordered(FrameOrder::kColumns),
       {"2x3: pic1.png pic3.jpg pic10.png pic2.png pic9.png pic11.png", " | "}},
      {six,
       ordered(FrameOrder::kColumnsSerpentine),
       {"2x3: pic1.png pic9.png pic10.png pic2.png pic3.jpg pic11.png", " | "}},
      {six, {}, {"6 pictures like pic1.png", "--grid"}},
      {{"a1.png", "a2.png", "a3.png", "a4.png"}, {}, {"--grid 2x2", "--order"}},
      {{"north.png", "east.png"}, shaped(1, 2), {"1x2: east.png north.png", " | "}},
      {{"a01.png", "a02.png", "a04.png"},
       shaped(2, 2),
       {"3 pictures for a 2x2 grid of 4", "row 1, column 0 (a03.png)"}},
      {{"a01.png", "a02.png", "a03.png"}, shaped(2, 2), {"row 1, column 1 (a04.png)"}},
      {{"a.png", "b.png", "c.png"}, shaped(2, 2), {"after c.png the view of row 1, column 1"}},
      {{"a1.png", "a2.png", "a3.png", "a4.png", "a5.png"},
       shaped(2, 2),
       {"5 pictures for a 2x2 grid of 4", "a5.png is the first one"}},
      {{"a1.png", "a2.png", "a02.png"}, shaped(2, 2), {"twice", "a2.png", "a02.png"}},
  });
}

TEST(ViewList, WhatIsNoFolderOfViews) {
  expect_lists({{{}, {}, {"no PNG, JPEG, TIFF, WebP, PPM or PGM"}},
                {{"b.gif", "a.bmp"}, {}, {"or PGM picture; a.bmp is of a kind that is not read"}},
                {{"0_0.png"}, shaped(0, 1), {"1 to 4096"}},
                {{"0_0.png"}, shaped(1, 4097), {"1 to 4096"}}});
  const test::TempFolder folder;
  test::put_file(folder / "file.png", std::string());
  EXPECT_NE(list(folder / "file.png").find("not a folder"), std::string::npos);
  EXPECT_FALSE(list_views(folder / "absent").has_value());
  std::filesystem::create_directory(folder / "02_02.png");
  EXPECT_NE(list(folder.path()).find("--grid"), std::string::npos) << "a folder is no picture";
}

}  // namespace
}  // namespace hmlfc::io
