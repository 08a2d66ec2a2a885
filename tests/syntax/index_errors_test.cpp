// Each error of the index, one by one (IDX-4 to IDX-6).
#include <cstdint>
#include <map>
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
  int records = 1;  // of the GROUP section, all the same

  Bytes file() const {
    NaiveBits root, group, tiles;
    root.put(root_mask, 64).put(root_first, 64);
    for (int i = 0; i < records; ++i) {
      group.put(tile_mask, 64).put(data, 48).put(offset_bits, 8).put(high_byte, 8);
    }
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

/// What finding a tile gives: "begin-end" in the section, "empty", or the error and its section.
std::string outcome(const OneGroup& group, uint64_t tile) {
  const auto found = group.find(tile);
  if (!found) {
    return std::string(error_name(found.error().code)) + " in " +
           std::string(section_name(found.error().section));
  }
  if (!*found) return "empty";
  return std::to_string((*found)->begin) + "-" + std::to_string((*found)->end);
}

constexpr const char* kBadRoot = "bad_root_entry in ROOT";
constexpr const char* kBadGroup = "bad_group_record in GROUP";
constexpr const char* kBadTile = "bad_tile_offset in TILE";

/// A change of the group, and what some of its tiles then give.
struct Case {
  const char* what;
  void (*change)(OneGroup&);
  std::map<uint64_t, std::string> tiles;
};

const Case kCases[] = {
    {"nothing",
     [](OneGroup&) {},
     {{0, "2-4"}, {5, "4-7"}, {6, "7-11"}, {1, "empty"}, {63, "empty"}, {64, "empty"}}},
    {"the first record is behind the section",
     [](OneGroup& g) { g.root_first = 1; },
     {{0, kBadRoot}, {64, "empty"}}},
    {"group 1 has record 1, which is not there",
     [](OneGroup& g) { g.root_mask = 0b11; },
     {{0, "2-4"}, {64, kBadRoot}}},
    {"16 times the number is 2^64",
     [](OneGroup& g) { g.root_first = uint64_t{1} << 60; },
     {{0, kBadRoot}}},
    {"the number of the next group's record does not wrap (CNV-1)",
     [](OneGroup& g) {
       g.root_mask = 0b11;
       g.root_first = ~uint64_t{0};
       g.records = 2;
     },
     {{0, kBadRoot}, {64, kBadRoot}}},
    {"offset_bits 0", [](OneGroup& g) { g.offset_bits = 0; }, {{0, kBadGroup}, {1, kBadGroup}}},
    {"offset_bits 33", [](OneGroup& g) { g.offset_bits = 33; }, {{0, kBadGroup}, {1, kBadGroup}}},
    {"offset_bits 64", [](OneGroup& g) { g.offset_bits = 64; }, {{0, kBadGroup}, {1, kBadGroup}}},
    {"offset_bits 255", [](OneGroup& g) { g.offset_bits = 255; }, {{0, kBadGroup}, {1, kBadGroup}}},
    {"a table that ends one byte behind the section",
     [](OneGroup& g) { g.data = 10; },
     {{0, kBadGroup}, {1, "empty"}}},
    {"a table at the end of the section",
     [](OneGroup& g) { g.data = 11; },
     {{0, kBadGroup}, {1, "empty"}}},
    {"a table behind the section",
     [](OneGroup& g) { g.data = 12; },
     {{0, kBadGroup}, {1, "empty"}}},
    {"the greatest place of a table",
     [](OneGroup& g) { g.data = (uint64_t{1} << 48) - 1; },
     {{0, kBadGroup}, {1, "empty"}}},
    {"a section of 1 byte", [](OneGroup& g) { g.tile_bytes = 1; }, {{0, kBadGroup}}},
    {"an empty section", [](OneGroup& g) { g.tile_bytes = 0; }, {{0, kBadGroup}}},
    {"a table of 12 bytes of 11", [](OneGroup& g) { g.offset_bits = 32; }, {{0, kBadGroup}}},
    {"a section that ends with the table", [](OneGroup& g) { g.tile_bytes = 2; }, {{0, kBadTile}}},
    {"a section that lacks the last byte",
     [](OneGroup& g) { g.tile_bytes = 10; },
     {{0, "2-4"}, {5, "4-7"}, {6, kBadTile}}},
    {"a first record without bytes",
     [](OneGroup& g) { g.ends[0] = 0; },
     {{0, kBadTile}, {5, "2-7"}}},
    {"a second record without bytes",
     [](OneGroup& g) { g.ends[1] = 2; },
     {{0, "2-4"}, {5, kBadTile}, {6, "4-11"}}},
    {"a record that ends before it begins", [](OneGroup& g) { g.ends[1] = 1; }, {{5, kBadTile}}},
    {"a record behind the one after it", [](OneGroup& g) { g.ends[1] = 10; }, {{6, kBadTile}}},
};

TEST(IndexErrors, EachAlone) {
  for (const Case& c : kCases) {
    OneGroup group;
    c.change(group);
    for (const auto& [tile, expected] : c.tiles) {
      EXPECT_EQ(outcome(group, tile), expected) << c.what << ", tile " << tile;
    }
  }
}

TEST(IndexErrors, EveryBitAboveOffsetBits) {
  for (unsigned bit = 0; bit < 8; ++bit) {
    OneGroup group;
    group.high_byte = 1u << bit;
    EXPECT_EQ(outcome(group, 0), kBadGroup) << bit;
  }
}

}  // namespace
}  // namespace hmlfc
