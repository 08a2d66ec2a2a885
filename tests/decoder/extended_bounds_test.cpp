// The bounds of BND-3 on random blocks of streams put together by hand.
#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "arithmetic/naive_integers.hpp"
#include "decoder/naive_stream.hpp"

namespace hmlfc {
namespace {

using test::NaiveImage;
using test::NaiveSize;
using test::NaiveStream;

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

void count(const NaiveStream& stream, const WalkCounter::Walk& walk, LevelWalks& level) {
  ASSERT_LE(walk.index_fields, kIndexFields);
  ASSERT_LE(walk.tile_fields, most_fields(walk.site.tile));
  ++level.all;
  const NaiveImage image{walk.site.level, walk.site.image_row, walk.site.image_col};
  const bool reference = stream.tree().reference(image) == image;
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

/// The coordinates of one axis that ref is asked for, less those of weight 0: `side` from `first`
/// on, displaced by `eighths` of a sample, in a plane of `size` samples.
std::set<uint32_t> blocks_touched(uint32_t first, uint32_t side, int64_t eighths, uint32_t size) {
  const int64_t whole = test::floor_of(eighths, 8);
  const int64_t count = side + (eighths % 8 != 0 ? 1 : 0);
  std::set<uint32_t> blocks;
  for (int64_t i = 0; i < count; ++i) {
    const int64_t at = test::between(0, int64_t{first} + whole + i, int64_t{size} - 1);
    blocks.insert(static_cast<uint32_t>(at) / side);
  }
  return blocks;
}

/// Walks to reference blocks that one level needs: every block that a sample of a weight stands in.
uint64_t reference_walks(const NaiveStream& stream, const NaiveImage& image,
                         const BlockAddress& at) {
  const StreamHeader& header = stream.header();
  const uint32_t side = header.block_size();
  const NaiveSize size = stream.tree().plane_size(at.plane);
  const bool halved = at.plane != Plane::kY && header.chroma_format == ChromaFormat::k420 &&
                      !header.has(Feature::kChromaMotion);
  const auto eighths = [&](int64_t component) {
    const int64_t u = component * test::power_of_two(3 - header.vector_precision);
    return halved ? test::rounded(u, 1) : u;
  };
  uint64_t walks = 0;
  for (const auto& from : stream.motion(image, at.plane, at.bx * side, at.by * side).references) {
    walks += blocks_touched(at.bx * side, side, eighths(from.vx), size.width).size() *
             blocks_touched(at.by * side, side, eighths(from.vy), size.height).size();
  }
  return walks;
}

/// Checks one block; returns the most walks of one level that is not keyed.
uint64_t check_block(const NaiveStream& stream, const Decoder& decoder, const BlockAddress& at) {
  WalkCounter counter;
  AccessCounts counts;
  EXPECT_TRUE(decoder.decode_block(at, {.trace = &counter, .counts = &counts}).has_value());
  EXPECT_EQ(counts.walks, counter.walks().size());
  std::map<int, LevelWalks> levels;
  for (const auto& walk : counter.walks()) count(stream, walk, levels[walk.site.level]);
  uint64_t most = 0;
  for (const auto& [l, walks] : levels) {
    EXPECT_LE(walks.own, 1u);
    EXPECT_LE(walks.motion, 1u);
    EXPECT_LE(walks.disparity, 1u);
    const auto& entry = stream.header().levels[static_cast<size_t>(l)];
    if (l == stream.header().tree_height || entry.key_references != 0) {
      EXPECT_TRUE(walks.references.empty()) << "key images take no walk";
      continue;
    }
    EXPECT_LE(walks.references.size(), 2u);
    NaiveImage own{0, at.view.row, at.view.col};
    while (own.level < l) own = stream.tree().parent(own);
    EXPECT_EQ(walks.all - walks.own - walks.motion - walks.disparity,
              reference_walks(stream, own, at))
        << "samples of weight 0 are not read";
    for (const auto& [image, blocks] : walks.references) {
      // Two references may be the same image.
      EXPECT_LE(blocks, walks.references.size() == 1 ? 8u : 4u);
    }
    most = std::max(most, walks.all);
  }
  EXPECT_LE(most, 11u);
  EXPECT_LE(counts.walks, static_cast<uint64_t>(11 * stream.header().tree_height + 3));
  EXPECT_LE(counts.steps, 63 * counts.walks);
  return most;
}

/// Checks random blocks of `stream`; counts them by the most walks of one level.
void check_blocks(std::mt19937& random, const NaiveStream& stream, int blocks,
                  std::map<uint64_t, int>& found) {
  const auto file = stream.file();
  const auto decoder = Decoder::open(file);
  ASSERT_TRUE(decoder.has_value());
  for (int i = 0; i < blocks; ++i) {
    ++found[check_block(stream, *decoder, test::draw_block(random, stream))];
  }
}

TEST(ExtendedBounds, RandomBlocksOfRandomStreams) {
  std::mt19937 random(1);
  std::map<uint64_t, int> found;
  for (int round = 0; round < 150; ++round) {
    const StreamHeader header = test::draw_extended_header(random, test::draw_flags(random) | 2);
    if (header.motion_tile_log2 == 0) continue;
    const NaiveStream stream(random, header, 4);
    check_blocks(random, stream, 60, found);
    ASSERT_FALSE(HasFailure()) << "round " << round;
  }
  EXPECT_GT(found[10], 10) << "blocks displaced between samples in both directions";
}

// Small vectors between samples, in both directions for both references.
TEST(ExtendedBounds, TheBoundOfALevelIsReached) {
  std::mt19937 random(3);
  std::map<uint64_t, int> found;
  for (int round = 0; round < 4; ++round) {
    StreamHeader header = test::draw_extended_header(random, 511);
    header.rows = header.cols = 6;
    header.width = header.height = 75;
    header.block_log2 = 2;
    header.tree_height = 1;
    header.cluster_rows = header.cluster_cols = 6;
    header.levels = {{3, 3, 0}, {1, 1, 0}};
    header.window = 30;
    header.vector_precision = 2;
    header.disparity_precision = 3;
    header.row_scale = 16;
    check_blocks(random, NaiveStream(random, header, 4), 800, found);
    ASSERT_FALSE(HasFailure()) << "round " << round;
  }
  EXPECT_GT(found[11], 5);
}

// Decoding begins at the lowest level whose ancestor is a key image (EXT-5).
TEST(ExtendedBounds, NothingAboveAKeyImageIsRead) {
  std::mt19937 random(2);
  StreamHeader header = test::draw_extended_header(random, 128);
  header.rows = header.cols = 4;
  header.tree_height = 2;
  header.cluster_rows = header.cluster_cols = 2;
  header.levels = {{1, 2, 0}, {1, 1, 1}, {1, 1, 0}};
  const NaiveStream stream(random, header, 4);
  const auto file = stream.file();
  const auto decoder = Decoder::open(file);
  for (uint32_t view = 0; view < 16; ++view) {
    WalkCounter counter;
    ASSERT_TRUE(decoder->decode_block({{view / 4, view % 4}, Plane::kY, 0, 0}, {.trace = &counter})
                    .has_value());
    ASSERT_FALSE(counter.walks().empty());
    for (const auto& walk : counter.walks()) EXPECT_EQ(walk.site.level, 0);
  }
}

}  // namespace
}  // namespace hmlfc
