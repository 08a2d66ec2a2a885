// Damaged streams: the paths that keep decoded references say what the golden path says, and the
// error of a block is its own (CNV-7, DEC-7, FIL-6).
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "decoder/naive_stream.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
using test::NaiveSize;
using test::NaiveStream;

void expect_same(const Result<std::vector<int32_t>>& a, const Result<std::vector<int32_t>>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (a) {
    ASSERT_EQ(*a, *b);
  } else {
    ASSERT_EQ(error_name(a.error().code), error_name(b.error().code));
    ASSERT_EQ(a.error().section, b.error().section);
    ASSERT_EQ(a.error().offset, b.error().offset);
  }
}

/// Decodes each block on demand and with kept references; returns the first error, row by row.
std::optional<Error> compare_blocks(const Decoder& decoder, ViewPos view, Plane plane,
                                    const NaiveSize& blocks) {
  std::optional<Error> first;
  for (uint32_t by = 0; by < blocks.height; ++by) {
    for (uint32_t bx = 0; bx < blocks.width; ++bx) {
      const BlockAddress at{view, plane, bx, by};
      const auto golden = decoder.decode_block(at);
      const auto kept = decoder.decode_block(at, {.references = ReferenceMode::kSparse});
      expect_same(golden, kept);
      if (!golden && !first) first = golden.error();
    }
  }
  return first;
}

// A plane decodes if each of its blocks does; else its error is that of the first that does not.
void compare_view(const Decoder& decoder, ViewPos view, Plane plane, const NaiveSize& blocks,
                  int& failed, int& decoded) {
  const auto first = compare_blocks(decoder, view, plane, blocks);
  ASSERT_FALSE(testing::Test::HasFailure());
  const auto whole = decoder.decode_plane(view, plane);
  ASSERT_EQ(whole.has_value(), !first.has_value());
  ++(first ? failed : decoded);
  if (!first) return;
  ASSERT_EQ(error_name(whole.error().code), error_name(first->code));
  ASSERT_EQ(whole.error().section, first->section);
  ASSERT_EQ(whole.error().offset, first->offset);
}

// Three flipped bits of groups and records.
void damage(std::mt19937& random, Bytes& file, const StreamHeader& header) {
  const SectionEntry& group = header.sections[2];
  const SectionEntry& tile = header.sections[3];
  const uint64_t end = tile.offset + tile.size;
  for (int flips = 0; flips < 3 && group.offset < end; ++flips) {
    const SectionEntry& section = random() % 8 == 0 ? group : tile;
    if (section.size == 0) continue;
    file[section.offset + random() % section.size] ^= static_cast<uint8_t>(1u << random() % 8);
  }
}

void compare_views(std::mt19937& random, const NaiveStream& stream, int& failed, int& decoded) {
  Bytes file = stream.file();
  const OpenOptions options{.check_sections = false};
  const auto intact = Decoder::open(file, options);
  ASSERT_TRUE(intact.has_value());
  const StreamHeader header = intact->header();
  damage(random, file, header);
  const auto decoder = Decoder::open(file, options);
  ASSERT_TRUE(decoder.has_value());
  for (uint32_t view = 0; view < 9; view += 2) {
    const Plane plane = kPlanes[random() % 3];
    ASSERT_NO_FATAL_FAILURE(compare_view(*decoder, {view / 3, view % 3}, plane,
                                         stream.tree().plane_blocks(plane), failed, decoded));
  }
}

// Streams of 3 x 3 views with the headers that `draw` gives; at least `least` planes decode, and as
// many fail.
void compare_rounds(unsigned seed, int rounds, int least,
                    const std::function<StreamHeader(std::mt19937&)>& draw) {
  std::mt19937 random(seed);
  int failed = 0;
  int decoded = 0;
  for (int round = 0; round < rounds; ++round) {
    StreamHeader header = draw(random);
    header.rows = header.cols = 3;
    const NaiveStream stream(random, header, 4);
    ASSERT_NO_FATAL_FAILURE(compare_views(random, stream, failed, decoded)) << "round " << round;
  }
  EXPECT_GT(failed, least) << "the damage is found";
  EXPECT_GT(decoded, least) << "and does not spread";
}

TEST(Damage, AllPathsAgree) { compare_rounds(1, 60, 30, test::draw_stream_header); }

TEST(Damage, AllPathsAgreeOnExtendedStreams) {
  compare_rounds(2, 150, 60, [](std::mt19937& random) {
    StreamHeader header = test::draw_extended_header(random, test::draw_flags(random) | 2);
    if (header.motion_tile_log2 == 0) header.motion_tile_log2 = 5;
    return header;
  });
}

}  // namespace
}  // namespace hmlfc
