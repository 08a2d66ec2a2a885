// Views as frames of a Y4M video.
#include "io/y4m.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/files.hpp"
#include "io/temp_folder.hpp"
#include "io/y4m_header.hpp"

namespace hmlfc::io {
namespace {

constexpr LightFieldShape kShape{3, 4, 7, 5, 8};

// A picture that tells which view it is.
RgbImage view_of(const LightFieldShape& shape, uint32_t row, uint32_t col) {
  RgbImage image{shape.width, shape.height, shape.depth, {}};
  const uint32_t range = 1u << shape.depth;
  for (uint32_t i = 0; i < 3 * shape.width * shape.height; ++i) {
    image.samples.push_back(static_cast<uint16_t>((row * 83 + col * 29 + i * 7919) % range));
  }
  return image;
}

std::filesystem::path written(const test::TempFolder& folder, const LightFieldShape& shape,
                              FrameOrder order, int bits) {
  const auto file = folder.path() / "views.y4m";
  auto video = Y4mWriter::create(file, shape, order, bits);
  for (size_t i = 0; i < size_t{shape.rows} * shape.cols; ++i) {
    const auto [row, col] = view_of_frame(i, {shape.rows, shape.cols}, order);
    EXPECT_TRUE(video->add(view_of(shape, row, col)));
  }
  EXPECT_TRUE(video->commit());
  return file;
}

IoResult<Y4mReader> opened(const std::string& content,
                           std::optional<GridShape> grid = GridShape{1, 1}) {
  const test::TempFolder folder;
  const auto file = folder.path() / "other.y4m";
  const auto* begin = reinterpret_cast<const uint8_t*>(content.data());
  EXPECT_TRUE(write_file(file, {begin, content.size()}));
  return Y4mReader::open(file, grid, std::nullopt);
}

std::string error_of(const std::string& content, std::optional<GridShape> grid = GridShape{1, 1}) {
  const auto video = opened(content, grid);
  return video ? "" : video.error().message;
}

TEST(Y4m, ViewsComeBackAtEveryDepth) {
  for (const auto& [word, order] : kFrameOrders) {
    for (int depth = 8; depth <= 12; ++depth) {
      LightFieldShape shape = kShape;
      shape.depth = depth;
      const test::TempFolder folder;
      const auto file = written(folder, shape, order, exact_video_bits(depth));
      const auto video = Y4mReader::open(file, std::nullopt, std::nullopt);
      ASSERT_TRUE(video) << video.error().message;
      EXPECT_EQ(video->shape(), shape);
      for (uint32_t row = 0; row < shape.rows; ++row) {
        for (uint32_t col = 0; col < shape.cols; ++col) {
          EXPECT_EQ(video->view(row, col).samples, view_of(shape, row, col).samples);
        }
      }
    }
  }
}

TEST(Y4m, SerpentineGoesBackInOddRows) {
  const GridShape grid{3, 4};
  EXPECT_EQ(view_of_frame(3, grid, FrameOrder::kSerpentine), (GridPosition{0, 3}));
  EXPECT_EQ(view_of_frame(4, grid, FrameOrder::kSerpentine), (GridPosition{1, 3}));
  EXPECT_EQ(view_of_frame(8, grid, FrameOrder::kSerpentine), (GridPosition{2, 0}));
  EXPECT_EQ(view_of_frame(4, grid, FrameOrder::kRaster), (GridPosition{1, 0}));
}

// What is given counts more than the note: read in the other order, odd rows are reversed.
TEST(Y4m, GridAndOrderThatAreGiven) {
  const test::TempFolder folder;
  const auto file = written(folder, kShape, FrameOrder::kRaster, 10);
  const auto video = Y4mReader::open(file, GridShape{2, 6}, FrameOrder::kSerpentine);
  ASSERT_TRUE(video);
  EXPECT_EQ(video->view(1, 0).samples, view_of(kShape, 2, 3).samples);
}

TEST(Y4m, BytesOfAFrame) {
  const test::TempFolder folder;
  const auto file = written(folder, {1, 1, 1, 1, 8}, FrameOrder::kRaster, 10);
  const auto mapped = map_file(file);
  const std::string text(mapped->bytes().begin(), mapped->bytes().end());
  // R, G, B are 0, 239, 222 (7919 and 2 * 7919 modulo 256): Y' 706, Cb 578, Cr 95.
  EXPECT_EQ(text, std::string("YUV4MPEG2 W1 H1 F30:1 Ip A1:1 C444p10 XCOLORRANGE=LIMITED "
                              "XHMLFC=1x1,raster,8\nFRAME\n") +
                      std::string("\xc2\x02\x42\x02\x5f\x00", 6));
}

using Samples = std::vector<uint16_t>;

// Samples of the view, and the note, of a video of one frame.
std::pair<Samples, std::string> read(const std::string& words, const std::string& frame) {
  const auto video = opened("YUV4MPEG2 " + words + "\nFRAME Ip\n" + frame);
  if (!video) return {{}, video.error().message};
  return {video->view(0, 0).samples, video->note()};
}

TEST(Y4m, OtherPrograms) {
  const std::string grey = "x\x80\x80";
  for (const char* words : {"C444", "XYSCSS=444", "C444 XYSCSS=420JPEG", "Cmono", "C422", "C420"}) {
    const auto frame = grey.substr(0, words == std::string("Cmono") ? 1 : 3);
    const auto [samples, note] = read(words + std::string(" W1 H1 XCOLORRANGE=FULL"), frame);
    EXPECT_EQ(samples, (Samples{120, 120, 120})) << words << note;
    EXPECT_EQ(note.find("interpolated") != note.npos, std::string(words).find("C42") == 0) << note;
  }
  EXPECT_EQ(read("W1 H1 Cmono", "\xeb"),
            (std::pair{Samples{255, 255, 255},
                       std::string("no XCOLORRANGE word: black is 16, white 235")}));
  EXPECT_EQ(read("W1 H1", grey).second.find("no C word: 4:2:0"), 0u);
  const std::string full = "W1 H1 XCOLORRANGE=FULL ";
  EXPECT_EQ(read(full + "Cmono16", "\xff\xff").first, (Samples{4095, 4095, 4095}));
  EXPECT_NE(read(full + "Cmono16", "\xff\xff").second.find("reduced to 12 bits"),
            std::string::npos);
  EXPECT_EQ(read(full + "Cmono9", "\x01\x01").first, (Samples{257, 257, 257}));
  EXPECT_NE(read(full + "C444p10", std::string("\xc0\xff", 2) + "\x01\x01\x01\x01")
                .second.find("frame 0 has samples of more than the 10 bits"),
            std::string::npos);
}

// A ramp of Cb along x and of Cr along y, in a frame of 6 x 4, is one of 4:4:4 as well.
TEST(Y4m, ChromaLiesWhereTheHeaderSays) {
  struct Case {
    const char* words;
    int x, y;  // by how much the ramps begin later
  };
  for (const auto& [words, first_x, first_y] : {Case{"C420jpeg", 2, 2},
                                                {"C420", 2, 2},
                                                {"", 2, 2},
                                                {"C420mpeg2", 0, 2},
                                                {"C420paldv", 0, 0},
                                                {"XYSCSS=420MPEG2", 0, 2}}) {
    std::string half(24, 'x');
    std::string each = half;
    for (int i = 0; i < 6; ++i) half += static_cast<char>(100 + 8 * (i % 3));
    for (int i = 0; i < 6; ++i) half += static_cast<char>(100 + 8 * (i / 3));
    for (int i = 0; i < 24; ++i) each += static_cast<char>(100 + 4 * (i % 6) - first_x);
    for (int i = 0; i < 24; ++i) each += static_cast<char>(100 + 4 * (i / 6) - first_y);
    const auto found = read(std::string("W6 H4 ") + words, half);
    const auto wanted = read("W6 H4 C444", each);
    ASSERT_EQ(found.first.size(), 72u) << found.second;
    for (size_t i = 0; i < 72; ++i) {
      const size_t x = i / 3 % 6;
      const size_t y = i / 18;
      if (x == 0 || x == 5 || y == 0 || y == 3) continue;  // no neighbour
      EXPECT_EQ(found.first[i], wanted.first[i]) << words << " " << i;
    }
  }
}

TEST(Y4m, WhatIsNotRead) {
  const std::string head = "YUV4MPEG2 W2 H1 C444";
  for (const auto& [content, says] : std::vector<std::pair<std::string, std::string>>{
           {"", "not a Y4M"},
           {"RIFF\n", "not a Y4M"},
           {std::string(5000, 'x'), "not a Y4M"},
           {"YUV4MPEG2 W2 H1\n", "(no C word: 4:2:0; no XCOLORRANGE word: black is 16"},
           {"YUV4MPEG2 W2 H1 C411\n", "yuv444p10"},
           {"YUV4MPEG2 W2 H1 C444alpha\n", "C444alpha"},
           {"YUV4MPEG2 W2 H1 C420p17\n", "C420p17"},
           {"YUV4MPEG2 W2 H1 XYSCSS=410\n", "XYSCSS=410"},
           {"YUV4MPEG2 W2 C444\n", "lacks W or H"},
           {"YUV4MPEG2 W0 H1 C444\n", "W0"},
           {"YUV4MPEG2 W65537 H1 C444\n", "W65537"},
           {"YUV4MPEG2 W2x H1 C444\n", "W2x"},
           {head + " It\n", "interlaced"},
           {head + " XHMLFC=1x1,raster,13\n", "XHMLFC=1x1,raster,13"},
           {head + " XHMLFC=0x1,raster,8\n", "XHMLFC"},
           {head + " XHMLFC=1x1,spiral,8\n", "XHMLFC"},
           {head + "\n", "0 frames, not those of 1 x 1 views"},
           {head + "\nFRAME\n12345", "frame 0 is cut off"},
           {head + "\nFRAME\n123456FRAMX\n123456", "frame 1 does not begin with FRAME, at byte 33"},
           {head + "\nFRAME\n123456FRAME", "frame 1 does not begin"},
           {head + "\nFRAME\n123456FRAME\n123456", "2 frames"}}) {
    EXPECT_NE(error_of(content).find(says), std::string::npos) << content << error_of(content);
  }
  EXPECT_EQ(error_of(head + "\nFRAME\n123456"), "");
  EXPECT_NE(error_of(head + "\nFRAME\n123456", std::nullopt).find("--grid"), std::string::npos);
}

}  // namespace
}  // namespace hmlfc::io
