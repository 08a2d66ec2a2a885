#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/view_name.hpp"

namespace hmlfc::io {
namespace {

TEST(ViewName, ReadsCameraPlaces) {
  EXPECT_EQ(parse_camera_place("out_00_01_-382.679993_1095.175903"),
            (CameraPlace{-382.679993, 1095.175903}));
  EXPECT_EQ(parse_camera_place("out_00_01_+1._-.5_"), (CameraPlace{1, -0.5}));
  const std::string beyond_all_numbers = "out_00_01_1_" + std::string(400, '9');
  for (const std::string& stem : {std::string("out_00_01"), std::string("pic_00_01_1_2"),
                                  std::string("00_01"), beyond_all_numbers}) {
    EXPECT_FALSE(parse_camera_place(stem).has_value()) << stem;
  }
}

TEST(ViewName, ReadsCameraNumbers) {
  EXPECT_EQ(parse_camera_name("input_Cam000"), 0u);
  EXPECT_EQ(parse_camera_name("input_Cam080"), 80u);
  EXPECT_EQ(parse_camera_name("input_Cam12345678"), 12345678u);
  for (const char* stem : {"input_Cam", "input_Camx", "input_Cam1_", "Cam001", "input_Cam123456789",
                           "xinput_Cam001"}) {
    EXPECT_FALSE(parse_camera_name(stem).has_value()) << stem;
  }
}

TEST(ViewName, PadsToTheGridsDigits) {
  EXPECT_EQ(view_file_name(3, 4, 16, 16), "03_04.png");
  EXPECT_EQ(view_file_name(0, 0, 1, 1), "00_00.png");
  EXPECT_EQ(view_file_name(99, 7, 100, 100), "99_07.png");
  EXPECT_EQ(view_file_name(0, 100, 1, 101), "000_100.png");
  EXPECT_EQ(view_file_name(4095, 0, 4096, 1), "4095_0000.png");
}

TEST(NaturalOrder, OrdersAsPeopleNumber) {
  const std::vector<std::string> ordered = {
      "",
      "1",
      "2",
      "10",
      "a",
      "a1b2",
      "a1b10",
      "a2b1",
      "a10",
      "a10b",
      "a99999999999999999998",
      "a99999999999999999999",
      "a100000000000000000000",
      "b1",
      "b01x",
      "ba",
  };
  for (size_t i = 0; i < ordered.size(); ++i) {
    for (size_t j = 0; j < ordered.size(); ++j) {
      const auto order = natural_order(ordered[i], ordered[j]);
      EXPECT_EQ(order < 0, i < j) << ordered[i] << " and " << ordered[j];
      EXPECT_EQ(order == 0, i == j) << ordered[i] << " and " << ordered[j];
    }
  }
}

TEST(NaturalOrder, LeadingZerosDoNotCount) {
  EXPECT_TRUE(natural_order("a7", "a007") == 0);
  EXPECT_TRUE(natural_order("a0", "a000") == 0);
  EXPECT_TRUE(natural_order("a007b", "a7c") < 0);
}

}  // namespace
}  // namespace hmlfc::io
