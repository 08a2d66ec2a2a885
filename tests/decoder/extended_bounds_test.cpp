// The bounds of BND-3 on random blocks of random streams.
#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "support/streams.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc {
namespace {

using test::Bytes;

/// Counts the walks of each level and kind, and the fields of each: a walk begins with a mask of
/// ROOT.
class WalkCounter final : public TraceSink {
 public:
  struct Walk {
    BlockSite site;
    uint64_t index_fields = 0;
    uint64_t tile_fields = 0;
  };

  void on_field(const FieldRecord& record) override {
    const bool index = record.clause.starts_with("IDX");
    if (record.section == Section::kRoot && record.name == "mask") walks_.push_back({record.site});
    ASSERT_FALSE(walks_.empty());
    ++(index ? walks_.back().index_fields : walks_.back().tile_fields);
  }
  void on_stage(const StageRecord&) override {}

  const std::vector<Walk>& walks() const { return walks_; }

 private:
  std::vector<Walk> walks_;
};

// BND-1 less the index, and the step fields.
constexpr uint64_t kResidualFields = 176 + 66;
constexpr uint64_t kMotionFields = 3 + 8 * 5 + 1;
constexpr uint64_t kDisparityFields = 3;
constexpr uint64_t kIndexFields = 6;

uint64_t most_fields(TileKind kind) {
  if (kind == TileKind::kMotion) return kMotionFields;
  return kind == TileKind::kDisparity ? kDisparityFields : kResidualFields;
}

/// The walks of one level by what they are for.
struct LevelWalks {
  uint64_t own = 0;
  uint64_t motion = 0;
  uint64_t disparity = 0;
  std::map<std::pair<uint32_t, uint32_t>, uint64_t> references;  // by image
  uint64_t all = 0;
};

void count(const Geometry& geometry, const WalkCounter::Walk& walk, LevelWalks& level) {
  ASSERT_LE(walk.index_fields, kIndexFields);
  ASSERT_LE(walk.tile_fields, most_fields(walk.site.tile));
  ++level.all;
  const ImagePos image{walk.site.image_row, walk.site.image_col};
  const bool reference = geometry.is_reference(walk.site.level, image);
  if (walk.site.tile == TileKind::kMotion) {
    ++level.motion;
  } else if (walk.site.tile == TileKind::kDisparity) {
    ++level.disparity;
  } else if (reference && level.own > 0) {
    ++level.references[{image.row, image.col}];
  } else {
    ++level.own;
  }
}

/// Checks one block; returns the most walks of one level that is not keyed.
uint64_t check_block(const Decoder& decoder, const BlockAddress& at) {
  const StreamHeader& header = decoder.header();
  const Geometry geometry(header);
  WalkCounter counter;
  AccessCounts counts;
  EXPECT_TRUE(decoder.decode_block(at, {.trace = &counter, .counts = &counts}).has_value());
  EXPECT_EQ(counts.walks, counter.walks().size());
  std::map<int, LevelWalks> levels;
  for (const auto& walk : counter.walks()) count(geometry, walk, levels[walk.site.level]);
  uint64_t most = 0;
  for (const auto& [l, walks] : levels) {
    EXPECT_LE(walks.own, 1u);
    EXPECT_LE(walks.motion, 1u);
    EXPECT_LE(walks.disparity, 1u);
    if (geometry.level(l).keyed) {
      EXPECT_TRUE(walks.references.empty()) << "key images take no walk";
      continue;
    }
    EXPECT_LE(walks.references.size(), 2u);
    for (const auto& [image, blocks] : walks.references) {
      // Two references may be the same image.
      EXPECT_LE(blocks, walks.references.size() == 1 ? 8u : 4u);
    }
    most = std::max(most, walks.all);
  }
  EXPECT_LE(most, 11u);
  EXPECT_LE(counts.walks, static_cast<uint64_t>(11 * header.tree_height + 3));
  EXPECT_LE(counts.steps, 63 * counts.walks);
  return most;
}

/// Checks random blocks of `file`; counts them by the most walks of one level.
void check_blocks(vectors::Random& random, const Bytes& file, int blocks,
                  std::map<uint64_t, int>& found) {
  const auto decoder = Decoder::open(file);
  ASSERT_TRUE(decoder.has_value());
  for (int i = 0; i < blocks; ++i) {
    ++found[check_block(*decoder, test::draw_block(random, *decoder))];
  }
}

TEST(ExtendedBounds, RandomBlocksOfRandomStreams) {
  vectors::Random random(1);
  std::map<uint64_t, int> found;
  for (uint64_t seed = 0; seed < 250; ++seed) {
    check_blocks(random, vectors::random_stream(seed, {.main = false}), 60, found);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(found[10], 10) << "blocks displaced between samples in both directions";
}

}  // namespace
}  // namespace hmlfc
