// Output files appear complete or not at all; input files are mapped.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>

#include "io/files.hpp"
#include "io/temp_folder.hpp"

namespace hmlfc::io {
namespace {

using Names = std::set<std::string>;
using test::get_file;
using test::put_file;
using test::to_bytes;

TEST(AtomicFile, AppearsOnlyWithCommit) {
  const test::TempFolder folder;
  auto file = AtomicFile::create(folder / "a.bin");
  ASSERT_TRUE(file.has_value()) << file.error().message;
  ASSERT_TRUE(file->write(to_bytes("one ")).has_value());
  ASSERT_TRUE(file->write({}).has_value());
  ASSERT_TRUE(file->write(to_bytes("two")).has_value());
  const FileDescriptor nameless(::open(folder.path().c_str(), O_TMPFILE | O_WRONLY, 0600));
  if (nameless.get() >= 0) {
    EXPECT_EQ(folder.names(), Names{}) << "a process that is killed now leaves a file";
  } else {
    EXPECT_EQ(folder.names().begin()->rfind("a.bin.partial-", 0), 0u);
  }
  ASSERT_TRUE(file->commit().has_value());
  EXPECT_EQ(folder.names(), Names{"a.bin"});
  EXPECT_EQ(get_file(folder / "a.bin"), to_bytes("one two"));
}

TEST(AtomicFile, LeavesNothingWhenAbandoned) {
  const test::TempFolder folder;
  {
    auto file = AtomicFile::create(folder / "a.bin");
    ASSERT_TRUE(file.has_value());
    const AtomicFile moved = std::move(*file);
    EXPECT_EQ(folder.names().count("a.bin"), 0u);
  }
  EXPECT_EQ(folder.names(), Names{});
}

TEST(AtomicFile, KeepsTheOldContentUntilCommit) {
  const test::TempFolder folder;
  put_file(folder / "a.bin", std::string("old"));
  {
    auto file = AtomicFile::create(folder / "a.bin");
    ASSERT_TRUE(file.has_value());
    ASSERT_TRUE(file->write(to_bytes("new")).has_value());
    EXPECT_EQ(get_file(folder / "a.bin"), to_bytes("old"));
  }
  EXPECT_EQ(get_file(folder / "a.bin"), to_bytes("old"));
  ASSERT_TRUE(write_file(folder / "a.bin", to_bytes("new")).has_value());
  EXPECT_EQ(get_file(folder / "a.bin"), to_bytes("new"));
}

// Not even one with the same number, on a machine that shares the disk.
TEST(AtomicFile, ThePartialFileOfAnotherProcessStays) {
  const test::TempFolder folder;
  const std::string other = "a.bin.partial-" + std::to_string(::getpid());
  put_file(folder / other, std::string("half"));
  ASSERT_TRUE(write_file(folder / "a.bin", to_bytes("new")).has_value());
  EXPECT_EQ(folder.names(), (Names{"a.bin", other}));
  EXPECT_EQ(get_file(folder / "a.bin"), to_bytes("new"));
  EXPECT_EQ(get_file(folder / other), to_bytes("half"));
}

TEST(AtomicFile, WritersOfOneTargetHaveFilesOfTheirOwn) {
  const test::TempFolder folder;
  auto first = AtomicFile::create(folder / "a.bin");
  auto second = AtomicFile::create(folder / "a.bin");
  ASSERT_TRUE(first && second);
  ASSERT_TRUE(first->write(to_bytes("one")) && second->write(to_bytes("two")));
  ASSERT_TRUE(first->commit() && second->commit());
  EXPECT_EQ(get_file(folder / "a.bin"), to_bytes("two"));
}

/// Runs in a process of its own, whose files may not grow over 4096 bytes: as on a full disk, a
/// write fails half way. Exits with 0 if that was reported as it should be.
[[noreturn]] void write_to_a_full_disk(const std::filesystem::path& path) {
  ::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{4096, 4096};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  const auto result = write_file(path, test::Bytes(10000, 7));
  const bool named = !result &&
                     result.error().message.find(path.filename().string()) != std::string::npos &&
                     result.error().message.find("too large") != std::string::npos;
  std::_Exit(named ? 0 : 1);
}

TEST(AtomicFile, AFullDiskIsReportedAndChangesNothing) {
  const test::TempFolder folder;
  put_file(folder / "old.bin", std::string("old"));
  EXPECT_EXIT(write_to_a_full_disk(folder / "old.bin"), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(write_to_a_full_disk(folder / "new.bin"), testing::ExitedWithCode(0), "");
  EXPECT_EQ(folder.names(), Names{"old.bin"});
  EXPECT_EQ(get_file(folder / "old.bin"), to_bytes("old"));
}

TEST(AtomicFile, NeverReplacesWhatIsNoFile) {
  const test::TempFolder folder;
  std::filesystem::create_directory(folder / "folder");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const char* name : {"folder", "pipe"}) {
    const auto result = write_file(folder / name, to_bytes("x"));
    ASSERT_FALSE(result.has_value()) << name;
    EXPECT_NE(result.error().message.find("not a regular file"), std::string::npos);
  }
  EXPECT_TRUE(std::filesystem::is_directory(folder / "folder"));
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
  EXPECT_EQ(folder.names(), (Names{"folder", "pipe"}));
}

TEST(AtomicFile, WritesThroughALink) {
  const test::TempFolder folder;
  put_file(folder / "real.bin", std::string("old"));
  std::filesystem::create_symlink("real.bin", folder / "link.bin");
  ASSERT_TRUE(write_file(folder / "link.bin", to_bytes("new")).has_value());
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.bin"));
  EXPECT_EQ(get_file(folder / "real.bin"), to_bytes("new"));
  std::filesystem::create_symlink("absent.bin", folder / "dangling.bin");
  EXPECT_FALSE(write_file(folder / "dangling.bin", to_bytes("new")).has_value());
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "dangling.bin"));
  EXPECT_TRUE(write_file(folder / std::string(255, 'n'), to_bytes("new")).has_value());
  EXPECT_FALSE(AtomicFile::create(folder / std::string(256, 'n')).has_value());
}

TEST(MappedFile, ShowsAllBytes) {
  const test::TempFolder folder;
  test::Bytes content(100000);
  for (size_t i = 0; i < content.size(); ++i) content[i] = static_cast<uint8_t>(i * 7);
  test::put_file(folder / "a", content);
  auto file = map_file(folder / "a");
  ASSERT_TRUE(file.has_value()) << file.error().message;
  EXPECT_TRUE(std::ranges::equal(file->bytes(), content));
  const MappedFile moved = std::move(*file);
  EXPECT_TRUE(std::ranges::equal(moved.bytes(), content));
  EXPECT_TRUE(file->bytes().empty());
}

TEST(MappedFile, RefusesWhatIsNoRegularFile) {
  const test::TempFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const auto& path : {folder.path(), folder / "pipe", folder / "absent"}) {
    const auto file = map_file(path);
    ASSERT_FALSE(file.has_value()) << path;
    EXPECT_NE(file.error().message.find(path.string()), std::string::npos);
  }
}

}  // namespace
}  // namespace hmlfc::io
