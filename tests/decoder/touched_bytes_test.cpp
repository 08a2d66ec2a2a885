// The count of bytes read, against a plain set of lines.

#include <algorithm>
#include <cstdint>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <hmlfc/read_sink.hpp>

namespace hmlfc {
namespace {

TEST(TouchedBytes, CountsEachLineOnce) {
  constexpr uint64_t kFile = 100000;
  TouchedBytes touched(kFile);
  EXPECT_EQ(touched.bytes(), 0u);
  std::set<uint64_t> lines;
  std::mt19937 random(3);
  for (int n = 0; n < 300; ++n) {
    const uint64_t offset = random() % kFile;
    const uint64_t bytes = random() % std::min<uint64_t>(kFile - offset, 500);
    touched.on_read(offset, bytes);
    for (uint64_t at = offset; at < offset + bytes; ++at) lines.insert(at / 64);
    ASSERT_EQ(touched.bytes(), lines.size() * 64);
  }
  EXPECT_EQ(touched.key_samples(), 0u);
  touched.on_key_plane(12);
  touched.on_key_plane(30);
  EXPECT_EQ(touched.key_samples(), 42u);
  touched.on_read(kFile - 1, 1);
  touched.reset();
  EXPECT_EQ(touched.bytes(), 0u);
  EXPECT_EQ(touched.key_samples(), 0u);
}

}  // namespace
}  // namespace hmlfc
