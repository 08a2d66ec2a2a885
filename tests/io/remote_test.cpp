// Remote files: lines that are there, gaps, pages that go; what servers say; addresses.
#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "bits/sparse_bytes.hpp"
#include "remote/answer.hpp"
#include "remote/http_source.hpp"
#include "remote/transfer.hpp"

namespace hmlfc::remote {
namespace {

void load(SparseBytes& file, ByteRange range) {
  for (const ByteRange& part : file.missing({&range, 1}, 0)) {
    const auto room = file.room(part);
    for (size_t i = 0; i < room.size(); ++i) {
      room[i] = static_cast<uint8_t>((part.offset + i) * 7 % 251);
    }
    file.set_loaded(part);
  }
}

TEST(SparseBytes, LinesAgainstASetOfBytes) {
  constexpr uint64_t kSize = 3 * SparseBytes::kPageBytes + 100;
  std::mt19937 random(1);
  for (int run = 0; run < 50; ++run) {
    SparseBytes file(kSize);
    std::vector<bool> there(kSize);
    for (int step = 0; step < 20; ++step) {
      const uint64_t offset = random() % kSize;
      const ByteRange range{offset, random() % std::min<uint64_t>(kSize - offset + 1, 700)};
      bool all = true;
      for (uint64_t i = 0; i < range.bytes; ++i) all = all && there[offset + i];
      EXPECT_EQ(file.holds(range), all);
      if (step % 2 == 0) continue;
      load(file, range);
      for (uint64_t i = 0; i < range.bytes; ++i) {
        const uint64_t line = (offset + i) / 64 * 64;
        for (uint64_t k = line; k < std::min(line + 64, kSize); ++k) there[k] = true;
      }
      EXPECT_TRUE(file.holds(range));
    }
    for (uint64_t i = 0; i < kSize; ++i) {
      EXPECT_EQ(file.holds({i, 1}), there[i]);
      if (there[i]) {
        EXPECT_EQ(file.bytes()[i], i * 7 % 251);
      }
    }
  }
}

// But not across line 640, which is loaded.
TEST(SparseBytes, MissingLinesJoinAcrossGaps) {
  SparseBytes file(10000);
  load(file, {640, 64});
  const std::vector<ByteRange> ranges{{1300, 10}, {600, 200}, {610, 3}, {9990, 10}};
  using Ranges = std::vector<ByteRange>;
  EXPECT_EQ(file.missing(ranges, 0), (Ranges{{576, 64}, {704, 128}, {1280, 64}, {9984, 16}}));
  EXPECT_EQ(file.missing(ranges, 63), (Ranges{{576, 64}, {704, 128}, {1280, 64}, {9984, 16}}));
  EXPECT_EQ(file.missing(ranges, 64), (Ranges{{576, 64}, {704, 128}, {1280, 64}, {9984, 16}}));
  EXPECT_EQ(file.missing(ranges, 448), (Ranges{{576, 64}, {704, 640}, {9984, 16}}));
  EXPECT_EQ(file.missing({}, 0), Ranges{});
}

// Ranges come from the bytes of the file, which may be anything.
TEST(SparseBytes, RangesOutsideAreNeitherThereNorMissing) {
  SparseBytes file(10000);
  constexpr uint64_t kMost = UINT64_MAX;
  for (const ByteRange range : {ByteRange{10000, 1},
                                {9999, 2},
                                {0, 10001},
                                {kMost, 2},
                                {64, kMost},
                                {uint64_t{1} << 46, 0x7fffffff}}) {
    EXPECT_FALSE(file.contains(range));
    EXPECT_FALSE(file.holds(range));
    EXPECT_TRUE(file.missing({&range, 1}, 0).empty());
    EXPECT_TRUE(file.room(range).empty());
    file.set_loaded(range);
  }
  EXPECT_EQ(file.held_bytes(), 0u);
  EXPECT_TRUE(file.contains({10000, 0}));
}

TEST(SparseBytes, PagesUsedLongestAgoGoFirst) {
  constexpr uint64_t kPage = SparseBytes::kPageBytes;
  SparseBytes file(8 * kPage);
  for (uint64_t page = 0; page < 6; ++page) {
    load(file, {page * kPage + 128, 64});
    file.tick();
  }
  EXPECT_TRUE(file.holds({0 * kPage + 128, 64}));  // used now
  EXPECT_EQ(file.held_bytes(), 6 * kPage);
  file.drop_to(6 * kPage);
  EXPECT_EQ(file.held_bytes(), 6 * kPage);
  file.drop_to(3 * kPage + 1);
  EXPECT_EQ(file.held_bytes(), 3 * kPage);
  for (uint64_t page = 0; page < 6; ++page) {
    const bool kept = page == 0 || page >= 4;
    EXPECT_EQ(file.holds({page * kPage + 128, 64}), kept) << page;
    EXPECT_EQ(file.bytes()[page * kPage + 130] != 0, kept) << page;
  }
  load(file, {kPage + 128, 64});
  EXPECT_EQ(file.bytes()[kPage + 130], (kPage + 130) * 7 % 251);
}

TEST(SparseBytes, LongFilesTakeLittleMemory) {
  constexpr uint64_t kSize = uint64_t{1} << 40;
  SparseBytes file(kSize);
  ASSERT_TRUE(file.is_reserved());
  load(file, {kSize - 10, 10});
  EXPECT_TRUE(file.holds({kSize - 10, 10}));
  EXPECT_EQ(file.held_bytes(), SparseBytes::kPageBytes);
  EXPECT_FALSE(SparseBytes(uint64_t{1} << 62).is_reserved());
}

TEST(Answer, ContentRanges) {
  EXPECT_EQ(parse_content_range("bytes 5-9/20"), (ContentRange{5, 9, 20}));
  EXPECT_EQ(parse_content_range("BYTES 5-9/*"), (ContentRange{5, 9, std::nullopt}));
  for (const char* text : {"", "bytes", "bytes 5-9", "bytes 9-5/*", "bytes 5-9/*1", "bytes */20",
                           "bytes 9-5/20", "bytes 5-20/20", "bytes 5-9/20 ", "bytes -5/20",
                           "lines 5-9/20", "bytes 5-9/99999999999999999999"}) {
    EXPECT_FALSE(parse_content_range(text)) << text;
  }
}

TEST(Answer, HeadersOfTheLastAnswer) {
  AnswerHead head;
  for (const char* line : {"HTTP/1.1 302 Found\r\n", "ETag: \"old\"\r\n", "\r\n", "HTTP/2 206 \r\n",
                           "etag:  W/\"a b\" \r\n", "CONTENT-RANGE: bytes 0-1/2\r\n",
                           "Last-Modified: today\r\n", "nothing\r\n", "\r\n"}) {
    head.take(line);
  }
  EXPECT_EQ(head.status, 206);
  EXPECT_EQ(head.range, (ContentRange{0, 1, 2}));
  EXPECT_EQ(head.version(), "\"a b\"");
  head.take("HTTP/1.1 206 Partial Content\r\n");
  head.take("last-modified: today\r\n");
  EXPECT_EQ(head.version(), "today");
  EXPECT_FALSE(head.range);
}

TEST(Address, Schemes) {
  EXPECT_TRUE(is_address("http://a/b"));
  EXPECT_TRUE(is_address("HTTPS://a"));
  for (const char* path :
       {"http:/a", "https:/a/b", "ftp://a", "file:///a", "a.hmlfc", "", "/http://a"}) {
    EXPECT_FALSE(is_address(path)) << path;
  }
}

TEST(Redirection, AddressesInside) {
  for (const char* inside : {"127.0.0.1",
                             "127.255.0.9",
                             "10.0.0.1",
                             "172.16.0.1",
                             "172.31.255.255",
                             "192.168.7.7",
                             "169.254.169.254",
                             "100.64.0.1",
                             "100.127.1.1",
                             "0.0.0.0",
                             "::",
                             "::1",
                             "fe80::1",
                             "fe80::1%eth0",
                             "fd00::1",
                             "fc01::",
                             "::ffff:127.0.0.1",
                             "::ffff:10.1.2.3",
                             "",
                             "host"}) {
    EXPECT_TRUE(is_inside(inside)) << inside;
  }
  for (const char* outside : {"8.8.8.8", "172.32.0.1", "172.15.0.1", "192.169.0.1", "100.128.0.1",
                              "126.0.0.1", "128.0.0.1", "2606:4700::1111", "::ffff:8.8.8.8"}) {
    EXPECT_FALSE(is_inside(outside)) << outside;
  }
}

}  // namespace
}  // namespace hmlfc::remote
