// The disparity map of hand-made and of random streams (docs/rendering.md, section 8).
#include <hmlfc/disparity.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "render/render_cases.hpp"
#include "support/streams.hpp"
#include "syntax/geometry.hpp"
#include "syntax/motion_tile.hpp"
#include "syntax/tile_record.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
using test::StreamParts;

// Groups of 1 x 3 at every level, with their references in columns 1 and 4.
StreamHeader row_of_views(int tree_height) {
  StreamHeader header = test::row_of_views(tree_height);
  header.levels.assign(header.levels.size(), {1, 3, 0});
  return header;
}

PaletteEntry entry(uint8_t set, uint8_t choice, int16_t x = 0, int16_t y = 0) {
  return {set, choice, false, x, y};
}

// A motion tile of four motion blocks, each with the entry of its number.
Bytes four_entries(const std::vector<PaletteEntry>& palette, bool keyed) {
  return write_motion_tile({false, 5, palette, {0, 1, 2, 3}}, {true, !keyed});
}

// The disparities of the blocks in the four corners of a view, which different motion blocks and
// grid blocks hold.
std::vector<BlockDisparity> corners(const Bytes& file, ViewPos view) {
  const auto decoder = Decoder::open(file);
  std::vector<BlockDisparity> found;
  for (const uint32_t by : {0u, 9u}) {
    for (const uint32_t bx : {0u, 9u})
      found.push_back(block_disparity(*decoder, view, bx, by).value());
  }
  return found;
}

using Four = std::vector<BlockDisparity>;
constexpr BlockDisparity kNothing{0, 0};

TEST(DisparityMap, OfChoices) {
  StreamParts stream(row_of_views(0));
  stream.motion_tile(0, {0, 1}) = write_disparity_tile(std::vector<int16_t>{-5, -4, -3, -2});
  stream.motion_tile(0, {0, 2}) =
      four_entries({entry(1, 1), entry(0, 2), entry(0, 10, 7), entry(0, 8)}, true);
  stream.motion_tile(0, {0, 0}) =
      four_entries({entry(0, 0), entry(0, 11, 5), entry(0, 11, 5, 1), entry(0, 11, 5, 2)}, true);
  stream.motion_tile(0, {0, 3}) =
      four_entries({entry(3, 11, 5), entry(1, 11, 5), entry(0, 11, -5), entry(0, 11, 254)}, true);
  const Bytes file = stream.file();
  // Quarters of a pixel are 64 units. The reference image tells what its grid blocks hold.
  EXPECT_EQ(corners(file, {0, 1}), (Four{{-320, 3}, {-256, 3}, {-192, 3}, {-128, 3}}));
  // Own grid block; the one to the left; 7 quarters; below and left, which is clamped to the left.
  EXPECT_EQ(corners(file, {0, 2}), (Four{{-320, 3}, {-320, 3}, {448, 2}, {-192, 3}}));
  // No motion; 5 half samples to the image one column to the right, then half a sample and one
  // sample aside.
  EXPECT_EQ(corners(file, {0, 0}), (Four{kNothing, {640, 2}, {640, 2}, {640, 1}}));
  // From column 3, K0 is in column 4, and K1 in column 1, on the other side. The last vector, of
  // 127 samples in one column, is within 16 bits.
  EXPECT_EQ(corners(file, {0, 3}), (Four{{-320, 2}, {640, 2}, {-640, 2}, {32512, 2}}));
  // Empty motion tiles have choice 1, and disparities of 0.
  EXPECT_EQ(corners(file, {0, 5}), (Four{{0, 3}, {0, 3}, {0, 3}, {0, 3}}));
  EXPECT_EQ(corners(file, {0, 4}), (Four{{0, 3}, {0, 3}, {0, 3}, {0, 3}}));
}

TEST(DisparityMap, OfALoneImageThereIsNone) {
  StreamHeader header = row_of_views(0);
  header.levels[0] = {1, 1, 0};
  StreamParts stream(header);
  stream.motion_tile(0, {0, 1}) = write_disparity_tile(std::vector<int16_t>{-5, -4, -3, -2});
  EXPECT_EQ(corners(stream.file(), {0, 1}), (Four{kNothing, kNothing, kNothing, kNothing}));
}

// No block uses what the record of the reference image cannot give.
TEST(DisparityMap, OfAReferenceImageThatCannotBeReadThereIsNone) {
  StreamParts stream(row_of_views(0));
  stream.motion_tile(0, {0, 1}) = {0xFF};
  stream.motion_tile(0, {0, 2}) =
      four_entries({entry(0, 10, 7), entry(0, 10, 7), entry(0, 10, 7), entry(0, 10, 7)}, true);
  const Bytes file = stream.file();
  const auto decoder = Decoder::open(file);
  EXPECT_EQ(corners(file, {0, 1}), (Four{kNothing, kNothing, kNothing, kNothing}));
  EXPECT_EQ(disparity_map(*decoder, {0, 1})->at(39, 39), kNothing);
  EXPECT_EQ(corners(file, {0, 2}), (Four{{448, 2}, {448, 2}, {448, 2}, {448, 2}}));
  // A block that uses it has its error.
  EXPECT_EQ(block_disparity(*decoder, {0, 0}, 0, 0).error().code, ErrorCode::kTileOverrun);
  EXPECT_EQ(disparity_map(*decoder, {0, 0}).error().code, ErrorCode::kTileOverrun);
}

TEST(DisparityMap, OfATree) {
  StreamParts stream(row_of_views(1));
  // Level 1 has three images, a column of which is two views; its reference is in column 1.
  stream.motion_tile(1, {0, 1}) = write_disparity_tile(std::vector<int16_t>{-5, -4, -3, -2});
  stream.motion_tile(1, {0, 2}) =
      four_entries({entry(0, 1), entry(0, 10, 7), entry(0, 11, 5), entry(0, 0)}, true);
  // Level 0 is not keyed.
  stream.motion_tile(0, {0, 5}) =
      four_entries({entry(0, 0), entry(0, 0), entry(0, 0), entry(0, 0)}, false);
  stream.motion_tile(0, {0, 3}) =
      four_entries({entry(0, 0), entry(0, 10, 7), entry(0, 11, 6), entry(0, 1)}, false);
  stream.motion_tile(0, {0, 4}) = write_disparity_tile(std::vector<int16_t>{1, 1, 1, 1});
  const Bytes file = stream.file();
  // All from level 1: -5 quarters in two views; 7; 5 half samples over two columns to the left.
  EXPECT_EQ(corners(file, {0, 5}), (Four{{-160, 3}, {224, 2}, {-320, 2}, kNothing}));
  // From level 1, whose image is the reference; then from level 0, without confidence.
  EXPECT_EQ(corners(file, {0, 3}), (Four{{-160, 3}, {448, 1}, {768, 1}, {64, 1}}));
}

// Groups of 3 x 1 in profile main: vectors of whole samples along a column of views.
TEST(DisparityMap, OfProfileMain) {
  StreamHeader header = test::some_header(0);
  header.rows = 3;
  header.cols = 1;
  header.width = header.height = 40;
  header.levels = {{3, 1, 0}};
  StreamParts stream(header);
  TileFields tile;
  tile.motion_mode = 3;
  tile.motion_mask = 0b101;  // of a quad of 2 x 2 blocks, the left ones
  tile.vectors.sign_mode = 0;
  tile.vectors.min_x = -1;
  tile.vectors.min_y = 3;
  tile.vectors.x = {level_code_for(2), {0, 1}, {}};
  tile.vectors.y = {level_code_for(2), {0, 1}, {}};
  const TileContext context =
      tile_context(StreamView{{}, header, stream.geometry}, {0, 0, 0, Plane::kY, 0, 0});
  stream.tile(0, {0, 0}, Plane::kY) = write_tile_fields(tile, context);
  const Bytes file = stream.file();
  const auto decoder = Decoder::open(file);
  // Vectors (-1, 3) and (0, 4) from row 0 to the reference in row 1.
  EXPECT_EQ(block_disparity(*decoder, {0, 0}, 0, 0).value(), (BlockDisparity{768, 1}));
  EXPECT_EQ(block_disparity(*decoder, {0, 0}, 1, 0).value(), kNothing);
  EXPECT_EQ(block_disparity(*decoder, {0, 0}, 0, 1).value(), (BlockDisparity{1024, 2}));
  EXPECT_EQ(block_disparity(*decoder, {1, 0}, 0, 0).value(), kNothing);
}

// Collects the vectors of plane Y by level.
class Vectors final : public TraceSink {
 public:
  void on_field(const FieldRecord&) override {}
  void on_stage(const StageRecord&) override {}
  void on_vector(const VectorRecord& record) override { first_.emplace(record.site.level, record); }

  // The first vector of the lowest level that has one; null: none.
  const VectorRecord* lowest() const { return first_.empty() ? nullptr : &first_.begin()->second; }

 private:
  std::map<int, VectorRecord> first_;
};

uint32_t power(uint32_t base, int exponent) {
  uint32_t product = 1;
  for (int i = 0; i < exponent; ++i) product *= base;
  return product;
}

// The vectors by which blocks are decoded: what the map says moves the block as far along the
// baseline, up to what rounding of vectors and disparities can change.
TEST(DisparityMap, AgreesWithTheVectorsOfTheDecoder) {
  uint64_t compared = 0;
  for (uint32_t seed = 0; seed < 300; ++seed) {
    const test::OpenedStream stream(vectors::random_stream(seed, {.tree_height = 2}));
    const Decoder& decoder = *stream.decoder;
    const StreamHeader& header = decoder.header();
    const Geometry geometry(header);
    vectors::Random random(seed);
    for (int n = 0; n < 40; ++n) {
      BlockAddress at = test::draw_block(random, decoder);
      const PlaneShape& plane = geometry.plane(Plane::kY);
      at = {at.view, Plane::kY, at.bx % plane.blocks_x, at.by % plane.blocks_y};
      Vectors vectors;
      ASSERT_TRUE(decoder.decode_block(at, {.trace = &vectors}).has_value());
      AccessCounts counts;
      const auto told = block_disparity(decoder, at.view, at.bx, at.by, &counts).value();
      EXPECT_LE(counts.walks, 2u * static_cast<unsigned>(header.tree_height + 1));
      const VectorRecord* vector = vectors.lowest();
      if (vector == nullptr || told.confidence == 0) continue;
      // Reference images below have no vector, but may tell a disparity.
      bool below = false;
      for (int l = 0; l < vector->site.level; ++l) {
        below =
            below || geometry.is_reference(l, geometry.ancestor({at.view.row, at.view.col}, 0, l));
      }
      const double most = 8.0 * header.window - 0.5;
      if (below || std::abs(vector->x) > most || std::abs(vector->y) > most) continue;
      const int level = vector->site.level;
      const double pitch = header.row_scale == 0 ? 1 : header.row_scale / 16.0;
      const double gx =
          (double(vector->image_col) - vector->site.image_col) * power(header.cluster_cols, level);
      double gy = (double(vector->image_row) - vector->site.image_row) * pitch;
      // Disparities of such levels take rows as columns (GEO-4).
      if (level > 0 && header.cluster_rows != header.cluster_cols) continue;
      gy *= power(header.cluster_rows, level);
      if (std::abs(told.disparity) == 32767 || told.disparity == -32768) continue;
      const double length = std::hypot(gx, gy);
      const double moved = (vector->x * gx + vector->y * gy) / 8 / length;
      const double said = told.disparity / 256.0 * length;
      ASSERT_NEAR(moved, said, 0.71 + length / 512 + 1e-9)
          << "seed " << seed << " view " << at.view.row << "," << at.view.col;
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000u);
}

// Maps read whole tiles; blocks are read one by one, also where streams are damaged.
TEST(DisparityMap, IsThatOfItsBlocks) {
  uint64_t errors = 0;
  for (uint32_t seed = 0; seed < 400; ++seed) {
    Bytes bytes = vectors::random_stream(seed, {.view_side = 40});
    test::Random random(seed);
    for (uint32_t n = 0; n < seed % 20; ++n) test::damage(random, bytes);
    const test::OpenedStream stream(bytes, {.check_sections = false});
    if (!stream.decoder) continue;
    const Decoder& decoder = *stream.decoder;
    const StreamHeader& header = decoder.header();
    const ViewPos view{random() % header.rows, random() % header.cols};
    const auto map = disparity_map(decoder, view);
    const uint32_t side = header.block_size();
    std::vector<BlockDisparity> blocks;
    std::optional<Error> error;
    for (uint32_t by = 0; by * side < header.height && !error; ++by) {
      for (uint32_t bx = 0; bx * side < header.width && !error; ++bx) {
        const auto block = block_disparity(decoder, view, bx, by);
        if (block) blocks.push_back(*block);
        if (!block) error = block.error();
      }
    }
    ASSERT_EQ(map.has_value(), !error.has_value()) << "seed " << seed;
    if (!map) {
      ++errors;
      EXPECT_EQ(error_name(map.error().code), error_name(error->code));
      EXPECT_EQ(map.error().offset, error->offset);
      continue;
    }
    EXPECT_EQ(map->blocks, blocks) << "seed " << seed;
    EXPECT_EQ(map->at(header.width - 1, header.height - 1), blocks.back());
  }
  EXPECT_GT(errors, 4u);
}

TEST(DisparityMap, RefusesWhatIsNotThere) {
  const test::OpenedStream stream(test::random_stream(1));
  const Decoder& decoder = *stream.decoder;
  const StreamHeader& header = decoder.header();
  const PlaneSize size = decoder.plane_size(Plane::kY);
  const uint32_t side = header.block_size();
  const auto code = [](const auto& result) { return result.error().code; };
  EXPECT_EQ(code(disparity_map(decoder, {header.rows, 0})), ErrorCode::kBadRequest);
  EXPECT_EQ(code(disparity_map(decoder, {0, header.cols})), ErrorCode::kBadRequest);
  EXPECT_EQ(code(block_disparity(decoder, {header.rows, 0}, 0, 0)), ErrorCode::kBadRequest);
  EXPECT_EQ(code(block_disparity(decoder, {0, 0}, (size.width + side - 1) / side, 0)),
            ErrorCode::kBadRequest);
  EXPECT_EQ(code(block_disparity(decoder, {0, 0}, 0, (size.height + side - 1) / side)),
            ErrorCode::kBadRequest);
}

// A slanted texture that moves by 3 pixels a column and a row: what the encoder finds is that.
TEST(DisparityMap, IsTheDisparityOfWhatWasEncoded) {
  LightField field({3, 3, 96, 64, 8});
  test::Random random(7);
  std::vector<uint16_t> noise(200 * 200);
  for (uint16_t& value : noise) value = static_cast<uint16_t>(random() % 256);
  std::vector<uint16_t> row(96 * 3);
  for (uint32_t r = 0; r < 3; ++r) {
    for (uint32_t c = 0; c < 3; ++c) {
      for (uint32_t y = 0; y < 64; ++y) {
        for (uint32_t x = 0; x < 96 * 3; ++x) {
          row[x] = noise[(y + 3 * (2 - r)) * 200 + x / 3 + 3 * (2 - c)];
        }
        field.write_row(r, c, y, row);
      }
    }
  }
  EncodeParams params;
  params.profile = Profile::kExtended;
  params.ref_rows = params.ref_cols = 3;
  const test::OpenedStream stream(encode(field, params)->bytes);
  for (uint32_t r = 0; r < 3; ++r) {
    const DisparityMap map = disparity_map(*stream.decoder, {r, r}).value();
    for (uint32_t y = 16; y < 48; ++y) {
      for (uint32_t x = 16; x < 80; ++x)
        ASSERT_EQ(map.at(x, y).disparity, 3 * 256) << x << "," << y;
    }
  }
}

}  // namespace
}  // namespace hmlfc
