// Each error of the index, one by one (IDX-4 to IDX-6).
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "bits/naive_bits.hpp"
#include "support/streams.hpp"
#include "syntax/header.hpp"
#include "syntax/index.hpp"
namespace hmlfc {
namespace {

using test::Bytes;
using test::NaiveBits;

/// One group with three tiles in lanes 0, 5 and 6: an end table of 3 x 4 bits, records of 2, 3 and
/// 4 bytes. The fields may be changed before it is read.
struct OneGroup {
  uint64_t root_mask = 1;
  uint64_t root_first = 0;
  uint64_t tile_mask = 0b1100001;
  uint64_t data = 0;
  unsigned offset_bits = 4;
  unsigned high_byte = 0;
  unsigned ends[3] = {2, 5, 9};
  size_t tile_bytes = 2 + 9;

  Bytes file() const {
    NaiveBits root, group, tiles;
    root.put(root_mask, 64).put(root_first, 64);
    group.put(tile_mask, 64).put(data, 48).put(offset_bits, 8).put(high_byte, 8);
    for (const unsigned end : ends) tiles.put(end, 4);
    tiles.put(0, 4);
    while (tiles.size() < tile_bytes * 8) tiles.put(0xAB, 8);
    StreamHeader header;
    header.rows = 3;
    header.cols = 10;  // 90 tiles, 2 groups
    header.levels = {{1, 1}};
    Bytes tile_section = tiles.bytes();
    tile_section.resize(tile_bytes);
    return test::file_of(header, {Bytes{}, root.bytes(), group.bytes(), tile_section});
  }

  Result<std::optional<TileExtent>> find(uint64_t tile) const {
    const Bytes bytes = file();
    const auto header = parse_header(bytes);
    EXPECT_TRUE(header.has_value());
    const StreamView view{bytes, *header, Geometry(*header)};
    EXPECT_TRUE(check_index_sizes(view).has_value());
    return find_tile(view, tile, Probe{});
  }
};

void expect_error(const OneGroup& group, uint64_t tile, std::string_view name, Section section) {
  const auto found = group.find(tile);
  ASSERT_FALSE(found.has_value()) << name;
  EXPECT_EQ(error_name(found.error().code), name);
  EXPECT_EQ(section_name(found.error().section), section_name(section));
}

void expect_extent(const OneGroup& group, uint64_t tile, uint64_t begin, uint64_t end) {
  const auto found = group.find(tile);
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  ASSERT_TRUE(found->has_value());
  EXPECT_EQ((*found)->begin, begin);
  EXPECT_EQ((*found)->end, end);
}

void expect_empty(const OneGroup& group, uint64_t tile) {
  const auto found = group.find(tile);
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_FALSE(found->has_value());
}

TEST(IndexErrors, WithoutFault) {
  const OneGroup group;
  expect_extent(group, 0, 2, 4);
  expect_extent(group, 5, 4, 7);
  expect_extent(group, 6, 7, 11);
  expect_empty(group, 1);
  expect_empty(group, 63);
  expect_empty(group, 64);
}

TEST(IndexErrors, RecordNumberPastTheGroupSection) {
  OneGroup group;
  group.root_first = 1;
  expect_error(group, 0, "bad_root_entry", Section::kRoot);
  expect_empty(group, 64);
  group = {};
  group.root_mask = 0b11;  // group 1 has record 1, which is not there
  expect_extent(group, 0, 2, 4);
  expect_error(group, 64, "bad_root_entry", Section::kRoot);
  group.root_first = uint64_t{1} << 60;  // times 16 is 2^64
  expect_error(group, 0, "bad_root_entry", Section::kRoot);
  group.root_first = ~uint64_t{0};
  expect_error(group, 0, "bad_root_entry", Section::kRoot);
}

// Integers are exact (CNV-1): 2^64 - 1 + 1 is past the section, not record 0.
TEST(IndexErrors, RecordNumberDoesNotWrap) {
  OneGroup group;
  group.root_mask = 0b11;
  group.root_first = ~uint64_t{0};
  expect_error(group, 64, "bad_root_entry", Section::kRoot);
}

TEST(IndexErrors, ImpossibleGroupRecord) {
  OneGroup group;
  for (const unsigned bits : {0u, 33u, 64u, 255u}) {
    group = {};
    group.offset_bits = bits;
    expect_error(group, 0, "bad_group_record", Section::kGroup);
    expect_error(group, 1, "bad_group_record", Section::kGroup);
  }
  for (unsigned bit = 0; bit < 8; ++bit) {
    group = {};
    group.high_byte = 1u << bit;
    expect_error(group, 0, "bad_group_record", Section::kGroup);
  }
}

TEST(IndexErrors, TablePastTheSection) {
  OneGroup group;
  for (const uint64_t data : {uint64_t{10}, uint64_t{11}, uint64_t{12}, (uint64_t{1} << 48) - 1}) {
    group.data = data;
    expect_error(group, 0, "bad_group_record", Section::kGroup);
    expect_empty(group, 1);
  }
  group = {};
  group.tile_bytes = 1;
  expect_error(group, 0, "bad_group_record", Section::kGroup);
  group.tile_bytes = 0;
  expect_error(group, 0, "bad_group_record", Section::kGroup);
  group = {};
  group.offset_bits = 32;  // 12 bytes of 11
  expect_error(group, 0, "bad_group_record", Section::kGroup);
}

// The table fits exactly, the records do not.
TEST(IndexErrors, TableAtTheEndOfTheSection) {
  OneGroup group;
  group.tile_bytes = 2;
  expect_error(group, 0, "bad_tile_offset", Section::kTile);
}

TEST(IndexErrors, RecordPastTheSection) {
  OneGroup group;
  group.tile_bytes = 10;  // the last of 9 bytes of records is missing
  expect_extent(group, 0, 2, 4);
  expect_extent(group, 5, 4, 7);
  expect_error(group, 6, "bad_tile_offset", Section::kTile);
}

TEST(IndexErrors, RecordThatEndsWhereItBeginsOrBefore) {
  OneGroup group;
  group.ends[0] = 0;
  expect_error(group, 0, "bad_tile_offset", Section::kTile);
  expect_extent(group, 5, 2, 7);
  group = {};
  group.ends[1] = 2;
  expect_extent(group, 0, 2, 4);
  expect_error(group, 5, "bad_tile_offset", Section::kTile);
  expect_extent(group, 6, 4, 11);
  group.ends[1] = 1;
  expect_error(group, 5, "bad_tile_offset", Section::kTile);
  group.ends[1] = 10;  // the record after it ends at 9
  expect_error(group, 6, "bad_tile_offset", Section::kTile);
}

}  // namespace
}  // namespace hmlfc
