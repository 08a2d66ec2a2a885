#include "io/disparity_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace hmlfc::io {
namespace {

TEST(WritePfm, BeginsWithTheLowestRow) {
  const auto path = std::filesystem::temp_directory_path() / "hmlfc_write_pfm_test.pfm";
  const float pixels[] = {1.0f, -0.5f, 0.0f, 2.0f, 3.0f, -4.0f};
  ASSERT_TRUE(write_pfm(path, 3, 2, pixels).has_value());
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove(path);
  // 2, 3, -4, then 1, -0.5, 0, as IEEE 754 has them.
  const std::string expected(
      "Pf\n3 2\n-1.0\n"
      "\x00\x00\x00\x40\x00\x00\x40\x40\x00\x00\x80\xC0"
      "\x00\x00\x80\x3F\x00\x00\x00\xBF\x00\x00\x00\x00",
      12 + 24);
  EXPECT_EQ(bytes, expected);
}

TEST(WritePfm, SaysWhereItCannotWrite) {
  const float pixel[] = {0};
  const auto written = write_pfm("/nowhere/map.pfm", 1, 1, pixel);
  ASSERT_FALSE(written.has_value());
  EXPECT_NE(written.error().message.find("/nowhere/map.pfm"), std::string::npos);
}

}  // namespace
}  // namespace hmlfc::io
