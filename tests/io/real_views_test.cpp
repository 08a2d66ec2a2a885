// The archives' own folders are understood as they are.
#include <gtest/gtest.h>

#include "io/data_folder.hpp"
#include "io/light_field_files.hpp"

namespace hmlfc::io {
namespace {

void expect_shape(const char* name, const LightFieldShape& shape) {
  const auto folder = real_data(name);
  if (!folder) GTEST_SKIP() << name << " is not here";
  const auto views = list_views(*folder);
  ASSERT_TRUE(views.has_value()) << views.error().message;
  const auto field = load_light_field(*views, 0);
  ASSERT_TRUE(field.has_value()) << field.error().message;
  EXPECT_EQ(field->shape(), shape);
}

TEST(RealViews, Chess) { expect_shape("stanford-chess-16x16-700x400", {16, 16, 700, 400, 8}); }

TEST(RealViews, Antinous) { expect_shape("hci-antinous-9x9-512x512", {9, 9, 512, 512, 8}); }

TEST(RealViews, Knights) {
  expect_shape("stanford-legoknights-17x17-256x256-jpeg", {17, 17, 256, 256, 8});
}

}  // namespace
}  // namespace hmlfc::io
