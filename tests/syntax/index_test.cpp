// The index against a linear reading of its sections, bit by bit (IDX-4 to IDX-7).
#include "syntax/index.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "bits/naive_bits.hpp"
#include "support/streams.hpp"
#include "syntax/header.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
using test::NaiveBits;
using test::SectionBytes;

constexpr uint64_t kGroups = 130;  // three root entries, the last one with two groups
constexpr size_t kRoot = 1, kGroup = 2, kTile = 3;

// 47 x 59 views of three tiles: 8319 tiles, one less than 130 groups hold.
StreamHeader many_tiles() {
  StreamHeader header;
  header.rows = 47;
  header.cols = 59;
  header.levels = {{1, 1}};
  return header;
}

constexpr uint64_t kTiles = 8319;

/// A file of these sections, opened.
class Stream {
 public:
  explicit Stream(const SectionBytes& sections)
      : file_(test::file_of(many_tiles(), sections)),
        header_(parse_header(file_).value()),
        view_{file_, header_, Geometry(header_)} {}
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  const StreamView& view() const { return view_; }

 private:
  Bytes file_;
  StreamHeader header_;
  StreamView view_;
};

/// The answer that find_tile should give.
struct Answer {
  ErrorCode code = ErrorCode::kOk;
  Section section = Section::kHeader;
  uint64_t offset = 0;  // in the section
  std::optional<TileExtent> extent;
};

Answer refused(ErrorCode code, Section section, uint64_t offset) {
  return {code, section, offset, {}};
}

/// Reads as the clauses say, counting each 1 bit one by one.
class LinearReader {
 public:
  explicit LinearReader(const SectionBytes& sections)
      : root_(sections[kRoot]), group_(sections[kGroup]), tiles_(sections[kTile]) {}

  Answer read(uint64_t tile) const {
    const uint64_t g = tile / 64;
    const uint64_t root_bit = g / 64 * 128;
    if (!root_[root_bit + g % 64]) return {};
    const uint64_t records = group_.size() / 128;
    uint64_t record = root_.field(root_bit + 64, 64);
    for (uint64_t k = 0; k < g % 64 && record < records; ++k)
      record += root_[root_bit + k] ? 1u : 0u;
    if (record >= records) return refused(ErrorCode::kBadRootEntry, Section::kRoot, g / 64 * 16);
    return read_group(record, tile % 64);
  }

 private:
  Answer read_group(uint64_t record, uint64_t lane) const {
    const uint64_t at = record * 128;
    const uint64_t data = group_.field(at + 64, 48);
    const auto width = static_cast<unsigned>(group_.field(at + 112, 8));
    const Answer bad_record = refused(ErrorCode::kBadGroupRecord, Section::kGroup, record * 16);
    if (width < 1 || width > 32 || group_.field(at + 120, 8) != 0) return bad_record;
    if (!group_[at + lane]) return {};
    uint64_t before = 0;
    uint64_t all = 0;
    for (uint64_t k = 0; k < 64; ++k) {
      if (k == lane) before = all;
      all += group_[at + k] ? 1u : 0u;
    }
    const uint64_t size = tiles_.size() / 8;
    const uint64_t records = data + (all * width + 7) / 8;
    if (records > size) return bad_record;
    const auto end_of = [&](uint64_t j) { return tiles_.field(data * 8 + j * width, width); };
    const uint64_t begin = records + (before == 0 ? 0 : end_of(before - 1));
    const uint64_t end = records + end_of(before);
    if (end <= begin || end > size) return refused(ErrorCode::kBadTileOffset, Section::kTile, data);
    return {ErrorCode::kOk, Section::kHeader, 0, TileExtent{begin, end}};
  }

  NaiveBits root_;
  NaiveBits group_;
  NaiveBits tiles_;
};

void expect_answer(const StreamView& view, uint64_t tile, const Answer& answer) {
  const auto found = find_tile(view, tile, Probe{});
  if (answer.code != ErrorCode::kOk) {
    ASSERT_FALSE(found.has_value()) << "tile " << tile << " " << error_name(answer.code);
    ASSERT_EQ(error_name(found.error().code), error_name(answer.code)) << "tile " << tile;
    ASSERT_EQ(found.error().section, answer.section);
    ASSERT_EQ(found.error().offset, view.entry(answer.section).offset + answer.offset);
    return;
  }
  ASSERT_TRUE(found.has_value()) << "tile " << tile << " " << to_string(found.error());
  ASSERT_EQ(found->has_value(), answer.extent.has_value()) << "tile " << tile;
  if (!answer.extent) return;
  ASSERT_EQ((*found)->begin, answer.extent->begin) << "tile " << tile;
  ASSERT_EQ((*found)->end, answer.extent->end) << "tile " << tile;
}

void compare_all(const SectionBytes& sections) {
  const Stream stream(sections);
  const LinearReader linear(sections);
  ASSERT_EQ(stream.view().geometry.tile_count(), kTiles);
  for (uint64_t tile = 0; tile < kTiles; ++tile) {
    ASSERT_NO_FATAL_FAILURE(expect_answer(stream.view(), tile, linear.read(tile)));
  }
}

/// A group record and its part of the TILE section.
struct Group {
  uint64_t tile_mask = 0;
  unsigned offset_bits = 1;
  std::vector<uint64_t> ends;
};

// Sections by hand: groups[g], those without tiles left out, with `gap` unused bytes between.
SectionBytes build(const std::vector<Group>& groups, size_t gap) {
  NaiveBits root, records, tiles;
  uint64_t used = 0;
  for (size_t first = 0; first < groups.size(); first += 64) {
    NaiveBits mask;
    const uint64_t first_record = used;
    for (size_t g = first; g < std::min(groups.size(), first + 64); ++g) {
      const Group& group = groups[g];
      mask.put(group.tile_mask != 0 ? 1 : 0, 1);
      if (group.tile_mask == 0) continue;
      ++used;
      for (size_t i = 0; i < gap; ++i) tiles.put(0xEE, 8);
      records.put(group.tile_mask, 64)
          .put(tiles.size() / 8, 48)
          .put(group.offset_bits, 8)
          .put(0, 8);
      for (const uint64_t end : group.ends) tiles.put(end, group.offset_bits);
      while (tiles.size() % 8 != 0) tiles.put(0, 1);
      for (uint64_t i = 0; i < group.ends.back(); ++i) tiles.put(i, 8);
    }
    root.put(mask.field(0, 64), 64).put(first_record, 64);
  }
  return {Bytes{}, root.bytes(), records.bytes(), tiles.bytes()};
}

std::vector<Group> draw_groups(std::mt19937_64& random, unsigned density) {
  std::vector<Group> groups(kGroups);
  for (size_t g = 0; g < kGroups; ++g) {
    Group& group = groups[g];
    if (random() % 4 >= density) continue;
    for (unsigned k = 0; k < density; ++k) group.tile_mask |= random() & random();
    if (g == kGroups - 1) group.tile_mask &= ~(uint64_t{1} << 63);  // 8319 tiles, not 8320
    uint64_t end = 0;
    for (int k = 0; k < std::popcount(group.tile_mask); ++k) {
      end += 1 + random() % 40;
      group.ends.push_back(end);
    }
    while ((end >> group.offset_bits) != 0) ++group.offset_bits;
    group.offset_bits += static_cast<unsigned>(random() % (33 - group.offset_bits));
  }
  return groups;
}

TEST(Index, FindsEveryTileOfHandBuiltSections) {
  std::mt19937_64 random(1);
  for (unsigned density = 1; density <= 4; ++density) {
    const SectionBytes sections = build(draw_groups(random, density), density - 1);
    ASSERT_NO_FATAL_FAILURE(compare_all(sections));
  }
}

TEST(Index, DamagedSectionsGiveTheErrorOfTheLinearReading) {
  std::mt19937_64 random(3);
  const SectionBytes intact = build(draw_groups(random, 2), 0);
  for (int round = 0; round < 150; ++round) {
    SectionBytes sections = intact;
    for (int flips = 0; flips < 4; ++flips) {
      Bytes& section = sections[kRoot + random() % 3];
      section[random() % section.size()] ^= static_cast<uint8_t>(1u << (random() % 8));
    }
    if (round % 3 == 0) sections[kTile].resize(random() % sections[kTile].size());
    if (round % 5 == 0) sections[kGroup].resize(random() % (sections[kGroup].size() / 16) * 16);
    ASSERT_NO_FATAL_FAILURE(compare_all(sections));
  }
}

}  // namespace
}  // namespace hmlfc
