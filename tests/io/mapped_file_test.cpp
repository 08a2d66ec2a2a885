#include <gtest/gtest.h>

#include <sys/stat.h>

#include <algorithm>
#include <string>
#include <utility>

#include "io/files.hpp"
#include "io/temp_folder.hpp"

namespace hmlfc::io {
namespace {

TEST(MappedFile, ShowsAllBytes) {
  const test::TempFolder folder;
  test::Bytes content(100000);
  for (size_t i = 0; i < content.size(); ++i) content[i] = static_cast<uint8_t>(i * 7);
  test::put_file(folder / "a", content);
  auto file = MappedFile::open(folder / "a");
  ASSERT_TRUE(file.has_value()) << file.error().message;
  EXPECT_TRUE(std::ranges::equal(file->bytes(), content));
  const MappedFile moved = std::move(*file);
  EXPECT_TRUE(std::ranges::equal(moved.bytes(), content));
  EXPECT_TRUE(file->bytes().empty());
}

TEST(MappedFile, AnEmptyFileIsAnEmptySpan) {
  const test::TempFolder folder;
  test::put_file(folder / "a", std::string());
  const auto file = MappedFile::open(folder / "a");
  ASSERT_TRUE(file.has_value());
  EXPECT_TRUE(file->bytes().empty());
}

TEST(MappedFile, RefusesWhatIsNoRegularFile) {
  const test::TempFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const auto& path : {folder.path(), folder / "pipe", folder / "absent"}) {
    const auto file = MappedFile::open(path);
    ASSERT_FALSE(file.has_value()) << path;
    EXPECT_NE(file.error().message.find(path.string()), std::string::npos);
  }
}

}  // namespace
}  // namespace hmlfc::io
