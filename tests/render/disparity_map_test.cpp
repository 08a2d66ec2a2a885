// The disparity map of random streams (docs/rendering.md, section 8). naive.depth has its values by
// their definition.
#include <hmlfc/disparity.hpp>

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "render/render_cases.hpp"
#include "support/streams.hpp"
#include "syntax/motion_tile.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
// No block uses what the record of the reference image cannot give.
TEST(DisparityMap, OfAReferenceImageThatCannotBeReadThereIsNone) {
  StreamHeader header = test::row_of_views(0);
  header.levels[0] = {1, 3, 0};  // references in columns 1 and 4
  test::StreamParts stream(header);
  stream.motion_tile(0, {0, 1}) = {0xFF};
  const PaletteEntry seven_quarters{0, 10, false, 7, 0};
  stream.motion_tile(0, {0, 2}) =
      write_motion_tile({false, 5, {seven_quarters}, {0, 0, 0, 0}}, {true, false});
  const Bytes file = stream.file();
  const auto decoder = Decoder::open(file);
  const auto in_corner = [&](uint32_t col) { return block_disparity(*decoder, {0, col}, 9, 9); };
  EXPECT_EQ(in_corner(1).value(), (BlockDisparity{0, 0}));
  EXPECT_EQ(disparity_map(*decoder, {0, 1})->at(39, 39), (BlockDisparity{0, 0}));
  EXPECT_EQ(in_corner(2).value(), (BlockDisparity{448, 2}));
  // A block that uses it has its error.
  EXPECT_EQ(in_corner(0).error().code, ErrorCode::kTileOverrun);
  EXPECT_EQ(disparity_map(*decoder, {0, 0}).error().code, ErrorCode::kTileOverrun);
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
