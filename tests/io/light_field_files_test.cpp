// Whole light fields to folders and back.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/image_files.hpp"
#include "io/light_field_files.hpp"
#include "io/sample_images.hpp"
#include "io/temp_folder.hpp"
#include "io/view_name.hpp"

namespace hmlfc::io {
namespace {

using test::Bytes;

LightField random_field(const LightFieldShape& shape) {
  LightField field(shape);
  for (uint32_t row = 0; row < shape.rows; ++row) {
    for (uint32_t col = 0; col < shape.cols; ++col) {
      field.set_view(row, col,
                     test::random_image(shape.width, shape.height, shape.depth, row * 100 + col));
    }
  }
  return field;
}

void expect_equal(const LightField& a, const LightField& b) {
  ASSERT_EQ(a.shape(), b.shape());
  for (uint32_t row = 0; row < a.shape().rows; ++row) {
    for (uint32_t col = 0; col < a.shape().cols; ++col) {
      ASSERT_EQ(a.view(row, col).samples, b.view(row, col).samples) << row << ", " << col;
    }
  }
}

/// Writes one view of a folder of 9 x 9 pixels views.
void put_view(const std::filesystem::path& folder, uint32_t row, uint32_t col, uint32_t width = 9,
              int depth = 8) {
  const RgbImage image = test::random_image(width, 9, depth, row * 10 + col);
  ASSERT_TRUE(write_png(folder / view_file_name(row, col, 3, 3), image).has_value());
}

void put_grid(const std::filesystem::path& folder) {
  for (uint32_t i = 0; i < 9; ++i) put_view(folder, i / 3, i % 3);
}

IoResult<LightField> load(const std::filesystem::path& folder, unsigned threads = 2) {
  return list_views(folder).and_then(
      [threads](const ViewList& views) { return load_light_field(views, threads); });
}

std::string load_error(const std::filesystem::path& folder) {
  const auto field = load(folder);
  EXPECT_FALSE(field.has_value());
  return field ? "" : field.error().message;
}

TEST(LightFieldFiles, SavedViewsAreReadBackExactly) {
  for (const LightFieldShape& shape :
       {LightFieldShape{3, 4, 10, 7, 8}, LightFieldShape{1, 11, 5, 5, 10},
        LightFieldShape{2, 2, 1, 1, 12}, LightFieldShape{1, 101, 2, 3, 9}}) {
    const test::TempFolder folder;
    const LightField field = random_field(shape);
    for (const unsigned threads : {0u, 1u, 3u}) {
      ASSERT_TRUE(save_views(folder / "new/views", field, threads).has_value());
      const auto again = load(folder / "new/views", threads);
      ASSERT_TRUE(again.has_value()) << again.error().message;
      expect_equal(*again, field);
    }
  }
}

TEST(LightFieldFiles, SaysEachKindOfLossOnceInTheOrderOfTheViews) {
  const test::TempFolder folder;
  for (uint32_t i = 0; i < 9; ++i) {
    test::PngContent content{.bit_depth = 16, .rows = {0, 0, 0, 0, 0, 0}};
    if (i == 2 || i == 7) content = {.bit_depth = 16, .colour_type = 6, .rows = Bytes(8)};
    if (i == 4) content.significant = {14, 14, 14};
    test::put_file(folder / view_file_name(i / 3, i % 3, 3, 3), test::make_png(content));
  }
  const auto views = list_views(folder.path());
  ASSERT_TRUE(views.has_value());
  Notes notes;
  ASSERT_TRUE(load_light_field(*views, 3, {}, &notes).has_value());
  const auto line = [&](size_t view, const std::string& what) {
    return views->files[view].string() + what;
  };
  const std::string reduced = " bits are reduced to 12 bits, the most that a stream holds";
  EXPECT_EQ(notes.lines(), (std::vector{line(0, " and 7 more: samples of 16" + reduced),
                                        line(2, " and 1 more: the alpha channel is dropped"),
                                        line(4, ": samples of 14" + reduced)}));
}

TEST(LightFieldFiles, ReportsProgressInRisingSteps) {
  const test::TempFolder folder;
  const LightField field = random_field({3, 4, 4, 4, 8});
  std::vector<size_t> saved;
  std::vector<size_t> loaded;
  const auto count_into = [](std::vector<size_t>& steps) {
    return [&steps](size_t done, size_t total) {
      EXPECT_EQ(total, 12u);
      steps.push_back(done);
    };
  };
  ASSERT_TRUE(save_views(folder.path(), field, 3, count_into(saved)).has_value());
  const auto views = list_views(folder.path());
  ASSERT_TRUE(views.has_value());
  ASSERT_TRUE(load_light_field(*views, 3, count_into(loaded)).has_value());
  const std::vector<size_t> expected = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  EXPECT_EQ(saved, expected);
  EXPECT_EQ(loaded, expected);
}

TEST(LightFieldFiles, NamesAViewOfOddSizeOrDepth) {
  struct Case {
    uint32_t row, col, width;
    int depth;
    std::string file, reason;
  };
  for (const Case& c :
       {Case{1, 2, 8, 8, "01_02.png",
             "row 1, column 2 has 8 x 9 pixels of 8 bits, expected 9 x 9 pixels of 8 bits like 8 "
             "other views"},
        Case{0, 0, 10, 8, "00_00.png", "row 0, column 0 has 10 x 9 pixels"},
        Case{2, 1, 9, 10, "02_01.png", "has 9 x 9 pixels of 10 bits"}}) {
    const test::TempFolder folder;
    put_grid(folder.path());
    put_view(folder.path(), c.row, c.col, c.width, c.depth);
    const std::string message = load_error(folder.path());
    EXPECT_NE(message.find(c.file), std::string::npos) << message;
    EXPECT_NE(message.find(c.reason), std::string::npos) << message;
  }
}

TEST(LightFieldFiles, NamesTheFirstDamagedViewWhateverTheThreads) {
  const test::TempFolder folder;
  put_grid(folder.path());
  for (const char* name : {"01_01.png", "02_00.png", "02_02.png"}) {
    test::put_file(folder / name, std::string("P6 damaged"));
  }
  for (int round = 0; round < 20; ++round) {
    EXPECT_NE(load_error(folder.path()).find("01_01.png"), std::string::npos);
  }
}

TEST(LightFieldFiles, SavesWhatAProducerMakesAndPassesItsErrorOn) {
  const test::TempFolder folder;
  const auto produce = [](uint32_t row, uint32_t col) -> IoResult<RgbImage> {
    if (row == 1 && col == 1) return file_error("stream", "broken");
    return RgbImage{1, 1, 8, {static_cast<uint16_t>(row), static_cast<uint16_t>(col), 0}};
  };
  EXPECT_TRUE(save_views(folder / "good", {1, 3}, produce, 2).has_value());
  const auto field = load(folder / "good");
  ASSERT_TRUE(field.has_value()) << field.error().message;
  EXPECT_EQ(field->view(0, 2).samples, (std::vector<uint16_t>{0, 2, 0}));
  const auto failed = save_views(folder / "bad", {2, 2}, produce, 2);
  ASSERT_FALSE(failed.has_value());
  EXPECT_EQ(failed.error().message, "stream: broken");
}

TEST(LightFieldFiles, AFolderThatCannotBeMadeIsAnError) {
  const test::TempFolder folder;
  test::put_file(folder / "file", std::string());
  const auto saved = save_views(folder / "file/views", random_field({1, 1, 1, 1, 8}), 1);
  ASSERT_FALSE(saved.has_value());
  EXPECT_NE(saved.error().message.find("file/views"), std::string::npos);
}

}  // namespace
}  // namespace hmlfc::io
