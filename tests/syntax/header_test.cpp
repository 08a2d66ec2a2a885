// Headers: written as FIL-1 says, read back as they were, and refused where they are cut or
// damaged. The errors of their fields, and their order, are vectors.
#include "syntax/header.hpp"

#include <cstdint>
#include <span>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "support/streams.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
using test::SectionBytes;

// Makes it one of profile extended: any flags with those that they need, and their fields (EXT-1,
// EXT-2, EXT-4).
void extend(StreamHeader& h) {
  h.profile = Profile::kExtended;
  h.feature_flags = *rc::gen::inRange(0u, 512u);
  if ((h.feature_flags & 60) != 0) h.feature_flags |= feature_bit(Feature::kMotionTiles);
  if (h.has(Feature::kMotionTiles)) h.motion_tile_log2 = *rc::gen::inRange(5u, 8u);
  if (h.has(Feature::kSubpelVectors)) h.vector_precision = *rc::gen::inRange(1u, 4u);
  if (h.has(Feature::kSharedDisparity)) {
    h.disparity_precision = *rc::gen::inRange(h.vector_precision, 6u);
    h.disparity_grid_log2 = *rc::gen::inRange(2u, 6u);
    h.row_scale = *rc::gen::inRange(-127, 128);
  }
  for (int level = 0; level < h.tree_height && h.has(Feature::kLevelKeys); ++level) {
    h.levels[static_cast<size_t>(level)].key_references = *rc::gen::inRange<uint8_t>(0, 2);
  }
}

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
  if (*rc::gen::arbitrary<bool>()) extend(h);
  return h;
}

Bytes draw_bytes() { return *rc::gen::scale(0.2, rc::gen::arbitrary<Bytes>()); }

RC_GTEST_PROP(Header, RoundTrip, ()) {
  const StreamHeader drawn = draw_header();
  const SectionBytes sections{draw_bytes(), draw_bytes(), draw_bytes(), draw_bytes()};
  const Bytes file = test::file_of(drawn, sections);
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

// The table of FIL-1, byte by byte.
TEST(Header, SpelledOut) {
  StreamHeader header = test::some_header(1);
  header.profile = Profile::kExtended;
  header.feature_flags = 511;
  header.vector_precision = 1;
  header.disparity_precision = 4;
  header.motion_tile_log2 = 6;
  header.disparity_grid_log2 = 3;
  header.row_scale = -2;
  header.levels[0].key_references = 1;
  header.sections[0] = {1, 0x04030201, 0x0C0B0A0908070605, 0x14131211100F0E0D};
  const Bytes start{0x89, 0x48, 0x4D, 0x4C, 0x46, 0x43, 0x0D, 0x0A,  // magic
                    1,    1,    152,  0,    0xFF, 1,    0,    0,     // version to feature_flags
                    5,    0,    7,    0,    100,  0,    0,    0,     // rows, cols, width
                    60,   0,    0,    0,    10,   1,    2,    16,    // height to window
                    2,    3,    1,    1,    4,    6,    3,    0xFE,  // cluster_rows to row_scale
                    0,    0,    0,    0,    2,    3,    0,    0,     // reserved, the top level
                    1,    2,    1,    0,    1,    0,    0,    0,     // level 0, a section's type
                    1,    2,    3,    4,    5,    6,    7,    8,    9,  10,
                    11,   12,   13,   14,   15,   16,   17,   18,   19, 20};
  const Bytes bytes = write_header(header);
  EXPECT_EQ(Bytes(bytes.begin(), bytes.begin() + 76), start);
}

TEST(Header, EveryTruncation) {
  const Bytes file =
      test::file_of(test::some_header(2), {Bytes(5, 1), Bytes(16), Bytes(), Bytes(3)});
  for (size_t length = 0; length < file.size(); ++length) {
    const auto parsed = parse_header(std::span(file).first(length));
    ASSERT_FALSE(parsed.has_value()) << length;
    EXPECT_EQ(parsed.error().code, ErrorCode::kTruncated) << length;
    EXPECT_EQ(parsed.error().offset, length);
  }
}

TEST(Header, EverySingleBitFlip) {
  const Bytes file = test::file_of(test::some_header(2), {});
  for (size_t bit = 0; bit < header_size(2) * 8; ++bit) {
    Bytes flipped = file;
    flipped[bit / 8] ^= static_cast<uint8_t>(1u << (bit % 8));
    EXPECT_FALSE(parse_header(flipped).has_value()) << bit;
  }
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
