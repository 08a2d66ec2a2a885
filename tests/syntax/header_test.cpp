// Valid headers: written as FIL-1 says, read back as they were.
#include "syntax/header.hpp"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "syntax/naive_header.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
using test::SectionBytes;

StreamHeader draw_header() {
  StreamHeader h;
  h.rows = *rc::gen::inRange(1u, 4097u);
  h.cols = *rc::gen::inRange(1u, 4097u);
  h.width = *rc::gen::inRange(1u, 65537u);
  h.height = *rc::gen::inRange(1u, 65537u);
  h.depth = *rc::gen::inRange(8, 13);
  h.chroma_format = *rc::gen::element(ChromaFormat::k420, ChromaFormat::k444);
  h.block_log2 = *rc::gen::inRange(1u, 4u);
  h.window = *rc::gen::inRange(0, 128);
  h.tree_height = *rc::gen::inRange(0, 16);
  h.cluster_rows = *rc::gen::inRange(1u, 256u);
  h.cluster_cols = *rc::gen::inRange(h.cluster_rows == 1 ? 2u : 1u, 256u);
  for (int level = 0; level <= h.tree_height; ++level) {
    h.levels.push_back({*rc::gen::inRange<uint8_t>(1, 255), *rc::gen::inRange<uint8_t>(1, 255)});
  }
  return h;
}

Bytes draw_bytes() { return *rc::gen::scale(0.2, rc::gen::arbitrary<Bytes>()); }

RC_GTEST_PROP(Header, RoundTrip, ()) {
  const StreamHeader drawn = draw_header();
  const SectionBytes sections{draw_bytes(), draw_bytes(), draw_bytes(), draw_bytes()};
  const Bytes file = test::naive_file(drawn, sections);
  const auto parsed = parse_header(file);
  RC_ASSERT(parsed.has_value());
  StreamHeader expected = drawn;
  expected.sections = parsed->sections;
  RC_ASSERT(*parsed == expected);
  RC_ASSERT(check_fields(*parsed).has_value());
  uint64_t offset = header_size(drawn.tree_height);
  for (size_t i = 0; i < 4; ++i) {
    RC_ASSERT(parsed->sections[i].type == i + 1);
    RC_ASSERT(parsed->sections[i].offset == offset);
    RC_ASSERT(parsed->sections[i].size == sections[i].size());
    offset += sections[i].size();
  }
}

RC_GTEST_PROP(Header, IsWrittenAsTheTableSays, ()) {
  StreamHeader header = draw_header();
  for (SectionEntry& entry : header.sections) {
    entry = {*rc::gen::arbitrary<uint32_t>(), *rc::gen::arbitrary<uint32_t>(),
             *rc::gen::arbitrary<uint64_t>(), *rc::gen::arbitrary<uint64_t>()};
  }
  RC_ASSERT(write_header(header) == test::naive_header(header));
}

TEST(Header, SizeOfEveryHeight) {
  for (int height = 0; height <= 15; ++height) {
    const StreamHeader header = test::some_header(height);
    EXPECT_EQ(header_size(height), 148u + 4u * static_cast<unsigned>(height));
    EXPECT_EQ(write_header(header).size(), header_size(height));
  }
}

TEST(Header, BothEndsOfEveryIntervalAreValid) {
  struct Ends {
    size_t offset;
    unsigned size;
    uint64_t lo, hi;
  };
  for (const Ends& field :
       {Ends{16, 2, 1, 4096}, Ends{18, 2, 1, 4096}, Ends{20, 4, 1, 65536}, Ends{24, 4, 1, 65536},
        Ends{28, 1, 8, 12}, Ends{29, 1, 0, 1}, Ends{30, 1, 1, 3}, Ends{31, 1, 0, 127},
        Ends{32, 1, 1, 255}, Ends{33, 1, 1, 255}, Ends{44, 1, 1, 255}, Ends{45, 1, 1, 255}}) {
    for (const uint64_t value : {field.lo, field.hi}) {
      Bytes file = test::naive_file(test::some_header(1), {});
      test::patch(file, field.offset, field.size, value);
      test::seal(file);
      EXPECT_TRUE(parse_header(file).has_value()) << value << " at " << field.offset;
    }
  }
}

TEST(Header, LevelEntriesStandFromTheTopDown) {
  StreamHeader header = test::some_header(2);
  header.levels = {{1, 2}, {3, 4}, {5, 6}};
  const Bytes bytes = write_header(header);
  EXPECT_EQ(Bytes(bytes.begin() + 44, bytes.begin() + 56),
            (Bytes{5, 6, 0, 0, 3, 4, 0, 0, 1, 2, 0, 0}));
}

TEST(Header, OneByOneClusterNeedsHeightZero) {
  StreamHeader header = test::some_header(0);
  header.cluster_rows = header.cluster_cols = 1;
  EXPECT_TRUE(parse_header(test::naive_file(header, {})).has_value());
}

TEST(Header, MethodNames) {
  StreamHeader header = test::some_header(0);
  header.levels = {{1, 1}};
  EXPECT_EQ(method_name(header), "intra");
  header.levels = {{1, 2}};
  EXPECT_EQ(method_name(header), "mc");
  header = test::some_header(1);
  header.levels = {{1, 1}, {1, 1}};
  EXPECT_EQ(method_name(header), "rlfc");
  header.levels = {{2, 1}, {1, 1}};
  EXPECT_EQ(method_name(header), "hmlfc");
}

}  // namespace
}  // namespace hmlfc
